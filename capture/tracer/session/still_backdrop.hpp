#pragma once
// What stands still behind a turntable, as one image in linear light.

#include "capture/tracer/session/session_plan.hpp"
#include "capture/tracer/session/turntable.hpp"
#include "rayspace/image/image.hpp"

#include <algorithm>
#include <cstdint>

namespace rs::capture {

// An edge that is as wide as a pixel is, for what is drawn point by point.

// 0 below -1 .. 1 above 1.
inline double soft_step(double t) {
    const double c = std::clamp(0.5 + 0.5 * t, 0.0, 1.0);
    return c * c * (3 - 2 * c);
}

// A table top that the disc stands on, with its shadow, and a wall behind: low contrast, out of focus, a few marks.
Image<RgbaF> wall_backdrop(const SessionPlan& plan, const Turntable& turntable, std::uint64_t seed);

// An even backdrop of this colour that falls off by a seventh towards the corners.
Image<RgbaF> even_backdrop(const Lens& lens, const glm::vec3& colour);

// `image` over the whole frame, stretched where its shape differs.
Image<RgbaF> image_backdrop(const Lens& lens, Image<RgbaF> image);

}  // namespace rs::capture
