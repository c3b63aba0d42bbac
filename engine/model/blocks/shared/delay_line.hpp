#pragma once
// The registers of a pipelined stage: what enters in a cycle leaves `stages` cycles later, and nothing moves where
// whoever takes it has no room. A member of blocks, not a block.

#include "rayspace/base/check.hpp"

#include <cstddef>
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

}  // namespace rs::engine::model
