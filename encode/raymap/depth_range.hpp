#pragma once
// The depths that the search tries: distances along a ray from its foot, in object radii.

namespace rs::encode {

// To either side of the foot; a little beyond the object radius.
inline constexpr double kDeepest = 1 + 1.0 / 32;

// Level n of 0..count-1 is low + n * step.
struct DepthRange {
    double low = -1;
    double step = 2.0 / 127;
    int count = 128;
    [[nodiscard]] double at(double level) const { return low + level * step; }
    [[nodiscard]] double level_of(double depth) const { return (depth - low) / step; }
};

}  // namespace rs::encode
