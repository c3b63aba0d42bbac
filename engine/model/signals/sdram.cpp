#include "engine/model/signals/sdram.hpp"

#include "rayspace/api/types/check.hpp"

#include <algorithm>

namespace rs::engine::model {

Sdram::Sdram(const SdramShape& shape, const SdramTiming& timing)
    : shape_(shape), timing_(timing), banks_(std::size_t{1} << shape.bank_bits) {
    pages_.resize(static_cast<std::size_t>((shape.words() + (std::uint64_t{1} << kPageBits) - 1) >> kPageBits));
}

bool Sdram::allows(SdramCommand command, WordAddress address, std::uint64_t now) const {
    if (now < any_from_) return false;
    const auto settled = [&](const Bank& b) { return b.row < 0 || now >= b.precharge_from; };
    switch (command) {
        case SdramCommand::activate:
            return bank(address).row < 0 && now >= bank(address).activate_from;
        case SdramCommand::read:
            return bank(address).row == row_of(address) && now >= bank(address).column_from;
        case SdramCommand::write:
            return bank(address).row == row_of(address) && now >= bank(address).column_from && now >= write_from_;
        case SdramCommand::precharge:
            return settled(bank(address));
        case SdramCommand::precharge_all:
            return std::all_of(banks_.begin(), banks_.end(), settled);
        case SdramCommand::refresh:
            return std::all_of(banks_.begin(), banks_.end(),
                               [&](const Bank& b) { return b.row < 0 && now >= b.activate_from; });
    }
    return false;
}

void Sdram::close(Bank& bank, std::uint64_t now) const {
    if (bank.row < 0) return;
    bank.row = -1;
    bank.activate_from = std::max(bank.activate_from, now + static_cast<std::uint64_t>(timing_.precharge_to_activate));
}

void Sdram::issue(SdramCommand command, WordAddress address, std::uint64_t now) {
    RS_CHECK(allows(command, address, now));
    ++issued_[static_cast<std::size_t>(command)];
    Bank& at = banks_[static_cast<std::size_t>(bank_of(address))];
    const auto after = [&](int cycles) { return now + static_cast<std::uint64_t>(cycles); };
    switch (command) {
        case SdramCommand::activate:
            at.row = row_of(address);
            at.column_from = after(timing_.activate_to_column);
            at.precharge_from = after(timing_.activate_to_precharge);
            at.activate_from = after(timing_.activate_to_activate);
            break;
        case SdramCommand::read:
            // Read data leave the chips at read_latency; one idle cycle follows before the board may drive the bus.
            write_from_ = after(timing_.read_latency + 2);
            at.precharge_from = std::max(at.precharge_from, after(1));
            break;
        case SdramCommand::write:
            at.precharge_from = std::max(at.precharge_from, after(1 + timing_.write_to_precharge));
            break;
        case SdramCommand::precharge:
            close(at, now);
            break;
        case SdramCommand::precharge_all:
            for (Bank& b : banks_) close(b, now);
            break;
        case SdramCommand::refresh:
            any_from_ = after(timing_.refresh_to_any);
            break;
    }
}

std::uint64_t Sdram::word(WordAddress address) const {
    const std::unique_ptr<Page>& page = pages_[address >> kPageBits];
    return page ? (*page)[address & ((1U << kPageBits) - 1U)] : 0;
}

void Sdram::set_word(WordAddress address, std::uint64_t value) {
    std::unique_ptr<Page>& page = pages_[address >> kPageBits];
    if (!page) page = std::make_unique<Page>();
    (*page)[address & ((1U << kPageBits) - 1U)] = value;
}

void Sdram::set_words(const MemorySegment& segment) {
    for (std::size_t n = 0; n < segment.words.size(); ++n) {
        set_word(segment.address + static_cast<WordAddress>(n), segment.words[n]);
    }
}

}  // namespace rs::engine::model
