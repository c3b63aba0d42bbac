#include "engine/rtl/simulation/sdram_chips.hpp"

namespace rs::engine::rtl {

std::uint64_t SdramChips::clock(const Pins& pins) {
    constexpr std::uint64_t kUndriven = 0xA5A5'5A5A'A5A5'5A5AU;
    const model::SdramShape& shape = sdram_.shape();
    data_.pop_back();
    data_.push_front(kUndriven);
    if (pins.command != 0) {
        last_ = pins;
        last_cycle_ = now_;
        const auto command = static_cast<model::SdramCommand>(pins.command - 1);
        const model::WordAddress address =
            pins.bank << (shape.row_bits + shape.column_bits) | pins.row << shape.column_bits | pins.column;
        if (!sdram_.allows(command, address, now_)) {
            if (error_.empty()) {
                error_ = "SDRAM command " + std::to_string(pins.command) + " in cycle " + std::to_string(now_) +
                         " breaks the timing rules";
            }
        } else {
            sdram_.issue(command, address, now_);
            if (command == model::SdramCommand::read) data_.front() = sdram_.word(address);
            if (command == model::SdramCommand::write) sdram_.set_word(address, pins.write_data);
        }
    }
    ++now_;
    return data_[static_cast<std::size_t>(sdram_.timing().read_latency)];
}

}  // namespace rs::engine::rtl
