#pragma once
// Rate-distortion optimised quantisation of one transform.

#include "encode/codec/coders.hpp"
#include "rayspace/codec/levels.hpp"

#include <cstdint>

namespace rs::encode {

struct QuantiserSettings {
    int size = 8;
    int kind = 0;      // of rayspace/codec/code/contexts.hpp
    int step = 0;      // index
    float weight = 1;  // of a squared error of the plane
    float lambda = 0;  // weighted squared error that a bit is worth
    bool sign_data_hiding = false;
};

// `coefficients`: as forward_transform() gives them. Levels of the least weight * squared error + lambda * bits
// (greedily, from the highest coefficient down, and then over where to stop); all zero where that is best. `levels`
// must be all zero; `last` is set where any is not. Returns whether any is not.
bool quantise(const std::int32_t* coefficients, const QuantiserSettings& settings, const CostTable& costs,
              codec::Levels& levels, int& last);

}  // namespace rs::encode
