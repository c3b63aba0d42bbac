#pragma once
// Effective depth: the number of depth steps along which a view ray crosses bands at the rate that it has at its foot
// (section 6 of engine/RECONSTRUCTION.md).
//
// Bands are measured from a reference viewpoint at distance D from the foot. At distance s behind the foot, the height
// of a ray above the reference ray through its foot appears reduced by D / (D + s). The offset in bands is therefore
// proportional to s D / (D + s) = s - s^2 / (D + s). The divisor is at least D / 2, so that points near the reference
// viewpoint remain within the range.

#include "engine/core/definition/fixed_point.hpp"
#include "rayspace/api/types/shape_map.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace rs::engine {

/// Effective depths of a ring with a shape map. All results are eighths of a depth step (q3).
class EffectiveDepth {
public:
    static constexpr int kDepths = 256;
    static constexpr std::int32_t kMax_q3 = 4095;  ///< greatest magnitude

    explicit EffectiveDepth(const ShapeMap& shape) {
        const auto in_steps = [&](std::int32_t length_q20) {
            return floor_divide(std::int64_t{length_q20} * 128, shape.depth_step_q24);
        };
        low_q3_ = static_cast<std::int32_t>(std::clamp(in_steps(shape.depth_low_q20), -kMaxLow_q3, kMaxLow_q3));
        reference_q3_ = static_cast<std::int32_t>(std::min(in_steps(shape.reference_distance_q20), kMaxReference_q3));
    }

    /// Effective depth of a whole depth step, 0 or greater; non-decreasing. Depths above 255 count as 255.
    [[nodiscard]] std::int32_t at(int depth) const {
        const std::int32_t s = low_q3_ + 8 * std::min(depth, kDepths - 1);
        const std::int32_t divisor = std::max(reference_q3_ + s, (reference_q3_ + 1) >> 1);
        return std::clamp(s - s * s / divisor, -kMax_q3, kMax_q3);
    }

    /// at() of all depths.
    [[nodiscard]] std::array<std::int32_t, kDepths> table() const {
        std::array<std::int32_t, kDepths> all{};
        for (int depth = 0; depth < kDepths; ++depth) all[static_cast<std::size_t>(depth)] = at(depth);
        return all;
    }

    /// Distance of depth 0 behind the foot; negative in front of it.
    [[nodiscard]] std::int32_t low_q3() const { return low_q3_; }
    /// Distance of the reference viewpoint from the axis.
    [[nodiscard]] std::int32_t reference_q3() const { return reference_q3_; }

private:
    static constexpr std::int64_t kMaxLow_q3 = 1 << 14;
    static constexpr std::int64_t kMaxReference_q3 = 1 << 28;

    std::int32_t low_q3_ = 0;
    std::int32_t reference_q3_ = 0;
};

}  // namespace rs::engine
