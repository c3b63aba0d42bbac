#pragma once
// The SDRAM at the pins of a module, beside the SDRAM of the model.

#include "engine/model/signals/sdram.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <array>
#include <deque>
#include <optional>
#include <string>

namespace rs::engine::rtl {

inline constexpr std::array kCommands{model::SdramCommand::activate,      model::SdramCommand::read,
                                      model::SdramCommand::write,         model::SdramCommand::precharge,
                                      model::SdramCommand::precharge_all, model::SdramCommand::refresh};

// The chips as the pins of the module see them: the contents are those of the model's chips, whose state is that before
// the module's last command left its output register.
template <class Module>
class SdramPins {
public:
    SdramPins(Module& module, const model::Sdram& sdram, Random& random)
        : module_(module), sdram_(sdram), random_(random) {}

    /// Reads the module's command and answers reads. Returns the difference from the model's last command, or "".
    std::string clock() {
        const std::size_t command = module_.sdram_command;  // 0: none
        const std::optional<model::SdramCommand> expected = issued_by_model();
        const bool is_same = expected ? command == static_cast<std::size_t>(*expected) + 1 : command == 0;
        const model::WordAddress address = address_on_pins();
        data_.push_front(random_.word());
        module_.sdram_read_data = data_[static_cast<std::size_t>(sdram_.timing().read_latency)];
        if (!is_same) return "SDRAM: the RTL issues command " + std::to_string(command) + " of 6, the model another";
        if (!expected) return {};
        const int bank = sdram_.bank_of(address);
        switch (*expected) {
            case model::SdramCommand::read:
                data_.front() = sdram_.word(address);
                return has_row(address);
            case model::SdramCommand::write:
                if (sdram_.word(address) != module_.sdram_write_data) return "SDRAM: another word is written";
                return has_row(address);
            case model::SdramCommand::activate:
                return has_row(address);
            case model::SdramCommand::precharge:
                return sdram_.is_open(bank) ? "SDRAM: another bank is closed" : std::string();
            case model::SdramCommand::precharge_all:
            case model::SdramCommand::refresh:
                break;
        }
        return {};
    }

private:
    [[nodiscard]] model::WordAddress address_on_pins() const {
        const model::SdramShape& shape = sdram_.shape();
        return (static_cast<model::WordAddress>(module_.sdram_bank) << (shape.row_bits + shape.column_bits)) |
               (static_cast<model::WordAddress>(module_.sdram_row) << shape.column_bits) | module_.sdram_column;
    }
    [[nodiscard]] std::string has_row(model::WordAddress address) const {
        return sdram_.has_row(sdram_.bank_of(address), sdram_.row_of(address)) ? "" : "SDRAM: another row";
    }
    std::optional<model::SdramCommand> issued_by_model() {
        std::optional<model::SdramCommand> issued;
        for (std::size_t n = 0; n < kCommands.size(); ++n) {
            const std::uint64_t count = sdram_.commands(kCommands[n]);
            if (count != counts_[n]) issued = kCommands[n];
            counts_[n] = count;
        }
        return issued;
    }

    Module& module_;
    const model::Sdram& sdram_;
    Random& random_;
    std::array<std::uint64_t, kCommands.size()> counts_{};
    std::deque<std::uint64_t> data_ = std::deque<std::uint64_t>(8);  // of the last cycles
};

}  // namespace rs::engine::rtl
