#pragma once
// The verilated board_top with its surroundings: clocks, host, SDRAM and disk.

#include "engine/rtl/simulation/disk_card.hpp"
#include "engine/rtl/simulation/host_side.hpp"
#include "engine/rtl/simulation/sdram_chips.hpp"

#include <cstdint>
#include <functional>

namespace rs::engine::rtl {

/// `Module`: a class that Verilator makes of board_top.
template <class Module>
class BoardSimulation {
public:
    BoardSimulation(Module& module, const model::BoardConfig& config)
        : module_(module),
          periods_(config.clock_periods()),
          chips_(config.memory),
          host_(config.pci),
          card_(config.disk) {
        module.rst = module.pci_rst = 1;
        for (int n = 0; n < 4; ++n) {
            edge(module.clk);
            edge(module.pci_clk);
        }
        module.rst = module.pci_rst = 0;
    }
    BoardSimulation(const BoardSimulation&) = delete;
    BoardSimulation& operator=(const BoardSimulation&) = delete;

    /// Events of the status registers; a cycle's number is the number of those before it.
    struct Status {
        std::uint64_t accepted = 0, refused = 0, begun = 0, ended = 0;
    };

    /// An edge of the board's clock, and the edges of the bus before the next one, as model::Simulator::step().
    void step() {
        set_board_inputs();
        module_.eval();
        take_board_outputs();
        edge(module_.clk, time_ns(board_cycles_, periods_.board));
        ++board_cycles_;
        for (phase_ += periods_.board; phase_ >= periods_.bus; phase_ -= periods_.bus) bus_edge();
    }

    /// `observer` is called with the time in nanoseconds after every change of a clock; for waveforms.
    void observe(std::function<void(std::uint64_t time_ns)> observer) { observer_ = std::move(observer); }

    [[nodiscard]] SdramChips& chips() { return chips_; }
    [[nodiscard]] HostSide& host() { return host_; }
    [[nodiscard]] DiskCard& card() { return card_; }
    [[nodiscard]] const Status& status() const { return status_; }
    [[nodiscard]] std::uint64_t board_cycles() const { return board_cycles_; }

private:
    template <class Clock>
    void edge(Clock& clock, std::uint64_t time_ns = 0) {
        clock = 1;
        module_.eval();
        if (observer_) observer_(time_ns);
        clock = 0;
        if (!observer_) return;
        module_.eval();
        observer_(time_ns + 1);  // the edges of the other clock are 2 ns away or more
    }
    // Times of the next edges. Those of the bus are just before the ends of its periods (model::Simulator).
    [[nodiscard]] std::uint64_t time_ns(std::uint64_t periods, int period) const {
        constexpr std::uint64_t kUnit_ns = 5;
        return periods * static_cast<std::uint64_t>(period) * kUnit_ns;
    }
    void set_board_inputs() {
        module_.sdram_read_data = chips_.clock({module_.sdram_command, module_.sdram_bank, module_.sdram_row,
                                                module_.sdram_column, module_.sdram_write_data});
        const DiskCard::Inputs inputs = card_.inputs();
        module_.load_available = inputs.load_available;
        module_.load_object = static_cast<std::uint8_t>(inputs.load_object);
        module_.timeout_cycles = inputs.timeout_cycles;
        module_.drive_has_data = inputs.has_data;
        module_.drive_data = inputs.data;
        module_.drive_address = inputs.address;
        module_.drive_is_last = inputs.is_last;
        module_.card_writes = inputs.writes_register;
        module_.card_object = static_cast<std::uint8_t>(inputs.write.object);
        module_.card_register = static_cast<std::uint8_t>(inputs.write.number);
        module_.card_data = inputs.write.data;
    }
    void take_board_outputs() {
        card_.clock(
            {module_.drive_takes != 0, module_.load_begins != 0, module_.load_ends != 0, module_.load_fails != 0});
        status_.accepted += module_.program_accepted;
        status_.refused += module_.program_refused;
        status_.begun += module_.cycle_begins;
        status_.ended += module_.cycle_ends;
    }
    void bus_edge() {
        module_.program_available = host_.has_program();
        module_.program_writes = static_cast<std::uint16_t>(host_.program_writes_count());
        const RegisterWrite write = host_.next_write();
        module_.program_address = write.address;
        module_.program_data = write.data;
        module_.pci_retry = host_.retries();
        module_.eval();
        host_.clock({module_.pci_state, module_.program_writes_register != 0, module_.pci_head != 0,
                     module_.pci_transfer != 0, module_.pci_data});
        edge(module_.pci_clk, time_ns(host_.clocks(), periods_.bus) - 2);
    }

    Module& module_;
    const model::BoardConfig::Periods periods_;
    SdramChips chips_;
    HostSide host_;
    DiskCard card_;
    Status status_;
    std::uint64_t board_cycles_ = 0;
    int phase_ = 0;
    std::function<void(std::uint64_t)> observer_;
};

}  // namespace rs::engine::rtl
