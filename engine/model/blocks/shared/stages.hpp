#pragma once
// The registers of a pipelined stage: what enters in a cycle leaves `stages` cycles later, and nothing moves where
// whoever takes it has no room. A member of blocks, not a block.

#include "engine/model/clock/block.hpp"
#include "rayspace/base/check.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace rs::engine::model {

template <class T>
class DelayLine {
public:
    explicit DelayLine(int stages) : places_(static_cast<std::size_t>(stages)) { RS_CHECK(stages >= 1); }

    [[nodiscard]] bool empty() const { return count_ == 0; }
    [[nodiscard]] bool leaves() const { return places_[at_].full; }  // in this cycle
    [[nodiscard]] const T& leaving() const { return places_[at_].item; }

    // Ends the cycle; what was leaving is gone.
    void advance() {
        count_ -= static_cast<int>(places_[at_].full);
        places_[at_].full = false;
        at_ = at_ + 1 == places_.size() ? 0 : at_ + 1;
    }
    // The same with an item that enters.
    void advance(const T& item) {
        const std::size_t place = at_;
        advance();
        places_[place] = {true, item};
        ++count_;
    }

private:
    struct Place {
        bool full = false;
        T item{};
    };
    std::vector<Place> places_;
    std::size_t at_ = 0;
    int count_ = 0;
};

// A delay line with the FIFO at its end: what a block works on for some cycles while it takes the next one. A member of
// blocks, not a block. Latency L = stages + 1: of an item that is visible in cycle t the result is visible in cycle
// t + L, and another one may enter in every cycle.
template <class T>
class PipelinedStage {
public:
    PipelinedStage(int stages, Fifo<T>& out) : line_(stages), out_(out) {}

    // Nothing is under way; what leaves in this cycle still is.
    [[nodiscard]] bool empty() const { return line_.empty(); }

    // A cycle. Where there is room for what leaves, `enter` sets the item that enters, if any, and returns what the
    // block does.
    template <class Enter>
    Activity step(Enter&& enter) {
        if (line_.leaves() && !out_.can_push()) return Activity::output_full;  // the whole stage stands
        if (line_.leaves()) out_.push(line_.leaving());
        std::optional<T> item;
        const Activity activity = enter(item);
        if (item) {
            line_.advance(*item);
        } else {
            line_.advance();
        }
        return activity;
    }

private:
    DelayLine<T> line_;
    Fifo<T>& out_;
};

// A block that works on one item at a time for a number of cycles that the item decides: a sequencer with its own
// multiplier. Latency L: an item that is visible in cycle t gives a result that is visible in cycle t + L; the next
// item is taken in cycle t + L.

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
    // Computes the result and returns the latency, at least 2.
    virtual int work(const In& in, Out& out) = 0;

private:
    Fifo<In>& in_;
    Fifo<Out>& out_;
    Out result_{};
    int left_ = 0;
};

}  // namespace rs::engine::model
