#pragma once
// Where in another image a unit is best predicted from.

#include "encode/codec/source_image.hpp"
#include "rayspace/codec/kernels/prediction.hpp"

#include <span>

namespace rs::encode {

struct MotionSearch {
    const SourceImage* source = nullptr;
    ConstImageView<std::uint8_t> reference;  // its Y
    int x = 0;                               // the unit
    int y = 0;
    int size = 16;
    int reach_x = 16;  // whole samples around each start
    int reach_y = 2;
    bool fractions = true;  // halves and quarters too, and what lies partly outside of the image
    int step = 1;           // whole samples between those that are looked at first; all neighbours of the best follow
    int neighbours = 8;     // in halves and quarters of a sample that are looked at: 8, or 4
    float bit_cost = 0;     // sum of absolute differences that a bit of a vector is worth
};

struct FoundMotion {
    codec::MotionVector vector;
    float cost = 0;  // sum of absolute differences of Y over the valid samples, and the vector's bits
};

// The best vector around any of `starts`, first in whole samples, then in halves and quarters (if wanted); `from` is
// what the vector is coded against. If `other` is not null, the mean of it (size x size samples, Y) and the prediction
// counts.
FoundMotion find_motion(const MotionSearch& search, std::span<const codec::MotionVector> starts,
                        codec::MotionVector from, const std::uint8_t* other = nullptr);

}  // namespace rs::encode
