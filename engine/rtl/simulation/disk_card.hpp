#pragma once
// Disk and its card at the pins of the RTL: the drive, whose sectors come off the platter into its buffer, and the
// firmware, which writes the registers of objects and gives the address of each word of a load.

#include "engine/model/blocks/memory/disk_controller.hpp"

#include <cstdint>
#include <deque>

namespace rs::engine::rtl {

/// Times of the drive, as the model has them (DiskSettings).
class Drive {
public:
    explicit Drive(const model::DiskSettings& settings) : settings_(settings) {}

    void begin(std::uint64_t now, std::uint64_t bytes);
    void clock(std::uint64_t now);
    void take() { sent_ += 2; }
    [[nodiscard]] bool has_data() const { return read_ > sent_; }
    [[nodiscard]] std::uint64_t sent_bytes() const { return sent_; }

private:
    model::DiskSettings settings_;
    std::uint64_t all_ = 0, read_ = 0, sent_ = 0, next_ = 0;
    bool has_stalled_ = false;
};

/// Word of object memory that has byte `at` of a load.
model::MemoryWrite word_at(const model::LoadJob& job, std::uint64_t at);
std::uint64_t bytes_of(const model::LoadJob& job);

/// A register of an object (engine/rtl/memory/register_file.sv).
struct ObjectRegisterWrite {
    int object = 0;
    int number = 0;
    std::uint32_t data = 0;
};

class DiskCard {
public:
    explicit DiskCard(const model::DiskSettings& settings) : settings_(settings), drive_(settings) {}

    void load(model::LoadJob job) { jobs_.push_back(std::move(job)); }
    /// Makes a slot valid whose words are in memory.
    void place(int slot, const model::ObjectRegisters& registers);
    void evict(int slot);

    struct Inputs {
        bool load_available = false;
        int load_object = 0;
        std::uint32_t timeout_cycles = 0;
        bool has_data = false;
        std::uint16_t data = 0;
        model::WordAddress address = 0;
        bool is_last = false;
        bool writes_register = false;
        ObjectRegisterWrite write;
    };
    /// Inputs of board_top in a clock cycle.
    Inputs inputs();
    struct Outputs {
        bool takes = false, begins = false, ends = false, fails = false;
    };
    /// Outputs of board_top in the same cycle.
    void clock(const Outputs& outputs);

    [[nodiscard]] bool has_loads() const { return !jobs_.empty(); }
    [[nodiscard]] bool is_idle() const { return jobs_.empty() && writes_.empty(); }
    [[nodiscard]] int begun() const { return begun_; }
    [[nodiscard]] int ended() const { return ended_; }  // including failed ones
    [[nodiscard]] int failed() const { return failed_; }

private:
    void write_registers(int slot, const model::ObjectRegisters& registers);

    model::DiskSettings settings_;
    Drive drive_;
    std::deque<model::LoadJob> jobs_;  // the first one in progress if `is_loading_`
    std::deque<ObjectRegisterWrite> writes_;
    bool is_loading_ = false;
    std::uint64_t now_ = 0;
    int begun_ = 0, ended_ = 0, failed_ = 0;
};

}  // namespace rs::engine::rtl
