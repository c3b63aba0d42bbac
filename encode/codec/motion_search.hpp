#pragma once
// Block motion search for a unit in another image.

#include "encode/codec/encoder_images.hpp"
#include "rayspace/codec/kernels/prediction.hpp"

#include <span>

namespace rs::encode {

struct MotionSearch {
    const SourceImage* source = nullptr;
    ConstImageView<std::uint8_t> reference;  // its Y
    int x = 0;                               // position of the unit, samples
    int y = 0;
    int size = 16;
    int reach_x = 16;  // whole samples around each start
    int reach_y = 2;
    bool fractions = true;  // also half and quarter samples, and positions partly outside of the image
    int step = 1;           // spacing of the first pass in whole samples; then all neighbours of the best are tested
    int neighbours = 8;     // tested per half-sample and quarter-sample refinement: 8 or 4
    float bit_cost = 0;     // sum of absolute differences equivalent to one bit of a vector
};

struct MotionMatch {
    codec::MotionVector vector;
    float cost = 0;  // sum of absolute differences of Y over the valid samples, and the vector's bits
};

/// Finds the best vector around any of `starts`, first in whole samples, then in half and quarter samples (if enabled).
/// \param from   predictor that the vector is coded against.
/// \param other  if not null, size x size samples of Y; their mean with the prediction is compared.
MotionMatch search_motion(const MotionSearch& search, std::span<const codec::MotionVector> starts,
                          codec::MotionVector from, const std::uint8_t* other = nullptr);

}  // namespace rs::encode
