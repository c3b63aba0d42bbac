#pragma once
// Registers of a pipelined stage: an item leaves `stages` cycles after it entered; nothing moves while the consumer has
// no space. A member of blocks, not a block.

#include "engine/model/clock/block.hpp"
#include "rayspace/api/types/check.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace rs::engine::model {

template <class T>
class DelayLine {
public:
    explicit DelayLine(int stages) : stages_(static_cast<std::size_t>(stages)) { RS_CHECK(stages >= 1); }

    [[nodiscard]] bool empty() const { return count_ == 0; }
    [[nodiscard]] bool has_output() const { return stages_[at_].full; }  // an item leaves in this cycle
    [[nodiscard]] const T& output() const { return stages_[at_].item; }

    // Ends the cycle; the leaving item is removed.
    void advance() {
        count_ -= static_cast<int>(stages_[at_].full);
        stages_[at_].full = false;
        at_ = at_ + 1 == stages_.size() ? 0 : at_ + 1;
    }
    // Ends the cycle with an item that enters.
    void advance(const T& item) {
        const std::size_t place = at_;
        advance();
        stages_[place] = {true, item};
        ++count_;
    }

private:
    struct Stage {
        bool full = false;
        T item{};
    };
    std::vector<Stage> stages_;
    std::size_t at_ = 0;
    int count_ = 0;
};

// A delay line with a FIFO at its end, for blocks that accept the next item while earlier ones are processed. A member
// of blocks, not a block. Latency L = stages + 1: the result of an item that is visible in cycle t is visible in cycle
// t + L; a new item may enter in every cycle.
template <class T>
class PipelinedStage {
public:
    PipelinedStage(int stages, Fifo<T>& out) : line_(stages), out_(out) {}

    // True if no item is in flight; an item that leaves in this cycle still is.
    [[nodiscard]] bool empty() const { return line_.empty(); }

    // Executes a cycle. Unless the output is full, `enter` sets the item that enters, if any, and returns the block's
    // activity.
    template <class Enter>
    Activity step(Enter&& enter) {
        if (line_.has_output() && !out_.can_push()) return Activity::output_full;  // the whole stage stalls
        if (line_.has_output()) out_.push(line_.output());
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

// A block that processes one item at a time, for a number of cycles that depends on the item: a sequencer with its own
// multiplier. Latency L: the result of an item that is visible in cycle t is visible in cycle t + L; the next item is
// taken in cycle t + L.

template <class In, class Out>
class SerialStage : public Block {
public:
    struct Ports {
        Fifo<In>& in;
        Fifo<Out>& out;
    };
    SerialStage(std::string name, std::string timing, const Ports& ports)
        : Block(std::move(name), std::move(timing)), in_(reads(ports.in)), out_(writes(ports.out)) {}

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
