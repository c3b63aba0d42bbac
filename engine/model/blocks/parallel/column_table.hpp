#pragma once
// The columns of the two stripes under way: a memory of 32 places inside of a block. A member of blocks, not a block.

#include "engine/model/signals/parallel_messages.hpp"

#include <array>

namespace rs::engine::model {

class ColumnTable {
public:
    ColumnTable() {
        for (ColumnSetup& setup : places_) setup.stripe = -1;
    }
    // With the first column of a stripe what is left of the one before in its place is forgotten (valid bits), for that
    // one may have been wider.
    void put(const ColumnSetup& setup) {
        if (setup.column == 0) {
            for (int n = 1; n < kStripeColumns; ++n) places_[place(setup.stripe, n)].stripe = -1;
        }
        places_[place(setup.stripe, setup.column)] = setup;
    }
    [[nodiscard]] const ColumnSetup& of(const ScannedPixel& pixel) const {
        return places_[place(pixel.stripe, pixel.column())];
    }
    // Its column has come.
    [[nodiscard]] bool holds(const ScannedPixel& pixel) const { return of(pixel).stripe == pixel.stripe; }

    static std::size_t place(int stripe, int column) {
        return static_cast<std::size_t>(stripe % kStripeSlots * kStripeColumns + column);
    }

private:
    std::array<ColumnSetup, std::size_t{kStripeSlots} * kStripeColumns> places_{};
};

}  // namespace rs::engine::model
