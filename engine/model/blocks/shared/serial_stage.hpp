#pragma once
// A block that works on one item at a time for a number of cycles that the item decides: a sequencer with its own
// multiplier. Latency L: an item that is visible in cycle t gives a result that is visible in cycle t + L; the next
// item is taken in cycle t + L.

#include "engine/model/clock/block.hpp"

namespace rs::engine::model {

template <class In, class Out>
class SerialStage : public Block {
public:
    SerialStage(std::string name, std::string timing, Fifo<In>& in, Fifo<Out>& out)
        : Block(std::move(name), std::move(timing)), in_(reads(in)), out_(writes(out)) {}

    Activity tick(std::uint64_t) final {
        if (left_ == 0) {
            if (!in_.can_pop()) return Activity::idle;
            left_ = work(in_.pop(), result_) - 1;
            RS_CHECK(left_ >= 1);
            return Activity::busy;
        }
        if (left_ > 1) {
            --left_;
            return Activity::busy;
        }
        if (!out_.can_push()) return Activity::output_full;
        out_.push(result_);
        left_ = 0;
        return Activity::busy;
    }

    [[nodiscard]] std::string state_text() const override { return "cycles left " + std::to_string(left_); }

protected:
    // Computes the result and says the latency, at least 2.
    virtual int work(const In& in, Out& out) = 0;

private:
    Fifo<In>& in_;
    Fifo<Out>& out_;
    Out result_{};
    int left_ = 0;
};

}  // namespace rs::engine::model
