#pragma once
// Rate-distortion optimised quantisation of one transform.

#include "encode/codec/coders.hpp"
#include "rayspace/codec/kernels/transform.hpp"

#include <cstdint>

namespace rs::encode {

struct QuantiserSettings {
    int size = 8;
    int kind = 0;      // block kind (rayspace/codec/code/contexts.hpp)
    int step = 0;      // index
    float weight = 1;  // weight of the plane's squared errors
    float lambda = 0;  // weighted squared error equivalent to one bit
    bool sign_data_hiding = false;
};

/// Minimises weight * squared error + lambda * bits (greedily, from the highest coefficient down, and then over the
/// last position). All levels are zero if that is best. \param coefficients  from forward_transform(). \param levels
/// must be all zero. \param last          set if any level is not zero. \return true if any level is not zero.
bool quantise(const std::int32_t* coefficients, const QuantiserSettings& settings, const CostTable& costs,
              codec::Levels& levels, int& last);

}  // namespace rs::encode
