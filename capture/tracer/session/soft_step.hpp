#pragma once
// An edge that is as wide as a pixel is, for what is drawn point by point.

#include <algorithm>

namespace rs::capture {

// 0 below -1 .. 1 above 1.
inline double soft_step(double t) {
    const double c = std::clamp(0.5 + 0.5 * t, 0.0, 1.0);
    return c * c * (3 - 2 * c);
}

}  // namespace rs::capture
