#pragma once
// Static background behind a turntable, as an image in linear light.

#include "capture/tracer/session/session_plan.hpp"
#include "capture/tracer/session/turntable.hpp"
#include "rayspace/image/image.hpp"

#include <algorithm>
#include <cstdint>

namespace rs::capture {

// Smooth step from 0 below -1 to 1 above 1, for antialiased edges in procedural images.
inline double soft_step(double t) {
    const double c = std::clamp(0.5 + 0.5 * t, 0.0, 1.0);
    return c * c * (3 - 2 * c);
}

/// Out-of-focus table top with the disc's shadow, and a wall with a few marks behind it; low contrast.
Image<RgbaF> wall_backdrop(const SessionPlan& plan, const Turntable& turntable, std::uint64_t seed);

/// Uniform backdrop with vignetting of one seventh at the corners.
Image<RgbaF> uniform_backdrop(const Lens& lens, const glm::vec3& colour);

/// Stretches `image` to the frame.
Image<RgbaF> image_backdrop(const Lens& lens, Image<RgbaF> image);

}  // namespace rs::capture
