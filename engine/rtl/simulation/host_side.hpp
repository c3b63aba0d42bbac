#pragma once
// Host at the bus of the RTL: writes the registers of programs, and receives images.

#include "engine/model/blocks/host/host_program.hpp"
#include "engine/model/signals/board_config.hpp"

#include <cstdint>
#include <deque>
#include <vector>

namespace rs::engine::rtl {

/// A 32-bit register of engine/rtl/memory/register_file.sv.
struct RegisterWrite {
    std::uint16_t address = 0;  // 12 bits
    std::uint32_t data = 0;
};

/// Register writes of a program, as many as HostProgram::register_writes. `objects`: registers by slot, for the number
/// of planes.
std::vector<RegisterWrite> program_writes(const model::ViewBank& bank,
                                          const std::vector<model::ObjectRegisters>& objects);

class HostSide {
public:
    explicit HostSide(const model::PciSettings& settings) : settings_(settings) {}

    void submit(std::vector<RegisterWrite> writes) { programs_.push_back(std::move(writes)); }

    /// Inputs of board_top in the next bus clock.
    [[nodiscard]] bool has_program() const { return !programs_.empty(); }
    [[nodiscard]] std::size_t program_writes_count() const { return has_program() ? programs_.front().size() : 0; }
    [[nodiscard]] RegisterWrite next_write() const {
        return has_program() ? programs_.front()[next_write_] : RegisterWrite{};
    }
    [[nodiscard]] bool retries() const {
        return settings_.retry_every > 0 && bursts_ % static_cast<std::uint64_t>(settings_.retry_every) == 0;
    }

    /// Outputs of board_top in a bus clock.
    struct Outputs {
        unsigned state = 0;
        bool writes_register = false;
        bool head = false;
        bool transfer = false;
        std::uint32_t data = 0;
    };
    void clock(const Outputs& outputs);

    [[nodiscard]] std::uint64_t clocks() const { return clocks_; }
    [[nodiscard]] unsigned last_state() const { return last_state_; }  // of the bus, in the last clock
    [[nodiscard]] std::uint64_t register_writes() const { return register_writes_; }
    /// Images in the order of their arrival; `view` and `last_view` are not set.
    [[nodiscard]] std::deque<model::HostImage>& images() { return images_; }
    [[nodiscard]] const std::deque<model::HostImage>& images() const { return images_; }

private:
    model::PciSettings settings_;
    std::deque<std::vector<RegisterWrite>> programs_;
    std::size_t next_write_ = 0;
    std::uint64_t clocks_ = 0;
    unsigned last_state_ = 0;
    std::uint64_t bursts_ = 0;
    std::uint64_t register_writes_ = 0;
    bool is_high_half_ = false;
    std::uint64_t low_half_ = 0;
    std::deque<model::HostImage> images_;
};

}  // namespace rs::engine::rtl
