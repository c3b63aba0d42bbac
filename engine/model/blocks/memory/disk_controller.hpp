#pragma once
// Disk controller: micro-controller with a hard disk, on its own card. Reads objects from the disk and sends them over
// the private bus (16 bits at 10 MHz, 20 MByte/s) into object memory, without any effect on rendering.
//
// An object becomes valid only after its last word is in memory. If the disk delivers no data (underrun) the load
// waits; after `timeout_cycles` without data the load fails and the object stays invalid.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/messages.hpp"
#include "engine/model/signals/registers.hpp"

#include <deque>
#include <memory>

namespace rs::engine::model {

struct LoadJob {
    int slot = 0;
    ObjectRegisters registers;
    std::shared_ptr<const std::vector<MemorySegment>> segments;
};

class DiskController final : public Block {
public:
    struct Load {
        int slot = 0;
        bool failed = false;
        std::uint64_t started = 0;  // board cycles
        std::uint64_t finished = 0;
        std::uint64_t bytes = 0;
        std::uint64_t underrun_cycles = 0;
    };

    struct Ports {
        Fifo<MemoryWrite>& words;
        Fifo<Done>& loaded;
        Fifo<Done>& object_ready;
    };
    DiskController(const DiskSettings& settings, RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override;

    // Command of the driver, over the card's own serial line. The slot must be invalid.
    void load(LoadJob job) { jobs_.push_back(std::move(job)); }
    [[nodiscard]] bool is_idle() const { return jobs_.empty(); }
    [[nodiscard]] bool is_loading(int slot) const;
    [[nodiscard]] const std::vector<Load>& loads() const { return loads_; }

private:
    void begin(std::uint64_t now);
    void read_platter(std::uint64_t now);
    void end(std::uint64_t now, bool failed);
    Activity send();

    DiskSettings settings_;
    RegisterFile& registers_;
    Fifo<MemoryWrite>& words_;
    Fifo<Done>& loaded_;
    Fifo<Done>& object_ready_;
    std::deque<LoadJob> jobs_;  // `active_`: the first one is in progress
    bool active_ = false;
    std::vector<Load> loads_;

    std::uint64_t platter_bytes_ = 0;  // bytes read into the drive's buffer
    std::uint64_t next_sector_ = 0;    // cycle in which the next sector is complete
    bool stalled_ = false;
    std::uint64_t sent_bytes_ = 0;
    std::uint64_t all_bytes_ = 0;
    std::size_t segment_ = 0;
    std::size_t word_ = 0;
    int wait_ = 0;  // cycles until the next bus transfer
    std::uint64_t last_byte_ = 0;
};

}  // namespace rs::engine::model
