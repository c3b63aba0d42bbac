#pragma once
// Render control: queue of rendering cycles, register banks and the two image buffers.
//
// A start command is accepted when a bank is free and every view's registers pass the check; the cycle then waits for
// the previous cycle and for its image buffer. Otherwise the whole cycle is refused with an error: queue overrun or bad
// registers. Bank and image buffer of a cycle have the same number, that of the cycle modulo 2.

#include "engine/model/blocks/host/host_program.hpp"
#include "engine/model/clock/block.hpp"
#include "engine/model/signals/messages.hpp"
#include "engine/model/signals/registers.hpp"

#include <deque>

namespace rs::engine::model {

class RenderControl final : public Block {
public:
    struct Ports {
        CrossingFifo<StartCommand>& commands;
        Fifo<ViewJob>& jobs;
        Fifo<Done>& view_written;
        Fifo<Done>& images_ready;
        Fifo<Done>& buffer_free;
        Fifo<Done>& object_ready;
    };
    RenderControl(const BoardConfig& config, RegisterFile& registers, const HostPrograms& programs, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override;

    // At most four cycles are drawn, delivered or waiting.
    static constexpr std::size_t kKeptCycles = 8;

    // Status registers.
    struct Cycle {
        std::uint64_t program = 0;
        std::uint64_t started = 0;   // board cycles
        std::uint64_t rendered = 0;  // the last word is in the image buffer
    };
    struct Refusal {
        std::uint64_t program = 0;
        std::string reason;
    };
    // The last cycles that have begun, up to kKeptCycles; the back is number cycles_begun() - 1.
    [[nodiscard]] const std::deque<Cycle>& cycles() const { return cycles_; }
    [[nodiscard]] std::uint64_t cycles_begun() const { return cycles_begun_; }
    [[nodiscard]] const Cycle& cycle(std::uint64_t number) const {
        const std::uint64_t from_end = cycles_begun_ - number;
        RS_CHECK(from_end >= 1 && from_end <= cycles_.size());
        return cycles_[cycles_.size() - static_cast<std::size_t>(from_end)];
    }
    [[nodiscard]] const std::vector<Refusal>& refusals() const { return refusals_; }
    [[nodiscard]] bool uses_object(int slot) const;                                 // by a waiting or rendering cycle
    [[nodiscard]] std::uint64_t commands_taken() const { return commands_taken_; }  // including refused ones

private:
    [[nodiscard]] bool is_free(int bank) const;
    bool take_command();
    bool finish_views(std::uint64_t now);
    bool start_views(std::uint64_t now);

    const BoardConfig& config_;
    RegisterFile& registers_;
    const HostPrograms& programs_;
    CrossingFifo<StartCommand>& commands_;
    Fifo<ViewJob>& jobs_;
    Fifo<Done>& view_written_;
    Fifo<Done>& images_ready_;
    Fifo<Done>& buffer_free_;
    Fifo<Done>& object_ready_;

    struct QueuedCycle {
        std::uint64_t program = 0;
        int bank = 0;
    };
    std::deque<QueuedCycle> queue_;  // `rendering_`: the first one is being rendered
    bool rendering_ = false;
    int next_view_ = 0;
    int written_views_ = 0;
    int next_bank_ = 0;
    std::uint64_t commands_taken_ = 0;
    bool buffer_busy_[2] = {false, false};
    std::deque<Cycle> cycles_;
    std::uint64_t cycles_begun_ = 0;
    std::vector<Refusal> refusals_;
};

}  // namespace rs::engine::model
