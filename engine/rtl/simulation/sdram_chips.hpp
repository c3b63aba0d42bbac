#pragma once
// SDRAM chips at the pins of the RTL. Every command is checked against the timing rules of the model's chips.

#include "engine/model/signals/sdram.hpp"

#include <cstdint>
#include <deque>
#include <string>

namespace rs::engine::rtl {

class SdramChips {
public:
    explicit SdramChips(const model::MemorySettings& settings) : sdram_(settings.shape, settings.timing) {}

    /// Pins of board_top during a clock cycle; `command` is 0 for none, else 1 + SdramCommand.
    struct Pins {
        unsigned command = 0;
        model::WordAddress bank = 0, row = 0, column = 0;
        std::uint64_t write_data = 0;
    };
    /// Reads the command of a clock cycle. Returns the read data on the pins in the same cycle.
    std::uint64_t clock(const Pins& pins);

    [[nodiscard]] model::Sdram& sdram() { return sdram_; }
    [[nodiscard]] const model::Sdram& sdram() const { return sdram_; }
    [[nodiscard]] const std::string& error() const { return error_; }  // the first illegal command, or ""
    [[nodiscard]] const Pins& last_command() const { return last_; }
    [[nodiscard]] std::uint64_t last_command_cycle() const { return last_cycle_; }

private:
    model::Sdram sdram_;
    std::uint64_t now_ = 0;
    std::deque<std::uint64_t> data_ = std::deque<std::uint64_t>(8);  // of the last cycles
    std::string error_;
    Pins last_;
    std::uint64_t last_cycle_ = 0;
};

}  // namespace rs::engine::rtl
