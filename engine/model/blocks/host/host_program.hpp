#pragma once
// What stands in the host's memory: the register values that its driver writes for each rendering cycle, and the
// images that the board sends. Not blocks: the world around the board.

#include "engine/model/signals/registers.hpp"
#include "rayspace/base/check.hpp"

#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

namespace rs::engine::model {

struct HostProgram {
    ViewBank bank;
    int register_writes = 0;  // 32-bit writes that carry it over the bus
};

// [number of the start command]: those that have not been forgotten. A board lives for many cycles.
class HostPrograms {
public:
    void push_back(HostProgram program) { kept_.push_back(std::move(program)); }
    [[nodiscard]] std::uint64_t size() const { return forgotten_ + kept_.size(); }  // forgotten ones count
    [[nodiscard]] const HostProgram& operator[](std::uint64_t number) const {
        RS_CHECK(number >= forgotten_ && number < size());
        return kept_[static_cast<std::size_t>(number - forgotten_)];
    }
    void forget_before(std::uint64_t number) {
        for (; forgotten_ < number && !kept_.empty(); ++forgotten_) kept_.pop_front();
    }
    [[nodiscard]] std::size_t kept() const { return kept_.size(); }

private:
    std::deque<HostProgram> kept_;
    std::uint64_t forgotten_ = 0;
};

struct HostImage {
    int view = 0;
    bool last_view = false;
    std::uint64_t arrived = 0;  // bus clock of its last word
    std::vector<std::uint64_t> words;
    std::size_t expected_words = 0;
};

}  // namespace rs::engine::model
