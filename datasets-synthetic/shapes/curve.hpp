#pragma once
// Smooth curves through control points, in the plane (lathe profiles, brush strokes) or in space (stems, wires).

#include "rayspace/api/types/check.hpp"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace rs::synthetic {

// Centripetal Catmull-Rom curve through `controls` (at least 2; neighbours must differ): no loops and no overshoot
// at uneven spacing (Yuksel, Schaefer, Keyser 2011). Each span gets `steps` (>= 1) points. An open curve ends with the
// last control point; a closed one does not repeat the first. Point is glm::vec2 or glm::vec3.
template <class Point>
std::vector<Point> smooth_curve(std::span<const Point> controls, int steps, bool closed = false) {
    const int count = static_cast<int>(controls.size());
    RS_CHECK(count >= 2 && steps >= 1);
    const auto control = [&](int i) -> Point {
        if (closed) return controls[static_cast<std::size_t>((i + count) % count)];
        // Control points beyond the ends are mirror images of the second points.
        if (i < 0) return 2.0F * controls[0] - controls[1];
        if (i >= count)
            return 2.0F * controls[static_cast<std::size_t>(count - 1)] - controls[static_cast<std::size_t>(count - 2)];
        return controls[static_cast<std::size_t>(i)];
    };
    const auto knot_step = [](const Point& a, const Point& b) {
        return std::max(1e-4F, std::sqrt(glm::length(b - a)));
    };
    std::vector<Point> curve;
    const int spans = closed ? count : count - 1;
    curve.reserve(static_cast<std::size_t>(spans * steps + 1));
    for (int span = 0; span < spans; ++span) {
        const Point p0 = control(span - 1);
        const Point p1 = control(span);
        const Point p2 = control(span + 1);
        const Point p3 = control(span + 2);
        const float t1 = knot_step(p0, p1);
        const float t2 = t1 + knot_step(p1, p2);
        const float t3 = t2 + knot_step(p2, p3);
        curve.push_back(p1);
        for (int step = 1; step < steps; ++step) {
            const float t = t1 + (t2 - t1) * static_cast<float>(step) / static_cast<float>(steps);
            const Point a1 = p0 * ((t1 - t) / t1) + p1 * (t / t1);
            const Point a2 = p1 * ((t2 - t) / (t2 - t1)) + p2 * ((t - t1) / (t2 - t1));
            const Point a3 = p2 * ((t3 - t) / (t3 - t2)) + p3 * ((t - t2) / (t3 - t2));
            const Point b1 = a1 * ((t2 - t) / t2) + a2 * (t / t2);
            const Point b2 = a2 * ((t3 - t) / (t3 - t1)) + a3 * ((t - t1) / (t3 - t1));
            curve.push_back(b1 * ((t2 - t) / (t2 - t1)) + b2 * ((t - t1) / (t2 - t1)));
        }
    }
    if (!closed) curve.push_back(controls[static_cast<std::size_t>(count - 1)]);
    return curve;
}

// Cubic step: 0 below `low`, 1 above `high`, with zero slope at both.
inline float smooth_step(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

}  // namespace rs::synthetic
