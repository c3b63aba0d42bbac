#include "datasets-synthetic/objects/petal.hpp"

#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/surfaces.hpp"
#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::synthetic {
namespace {

using glm::vec3;

float half_width(const PetalShape& shape, float t) {
    float share = 0.0F;
    if (t < shape.widest_at) {
        share = shape.base_width + (1.0F - shape.base_width) * smooth_step(0.0F, shape.widest_at, t);
    } else {
        const float x = std::min(1.0F, (t - shape.widest_at) / (1.0F - shape.widest_at));
        const float round = std::sqrt(std::max(0.0F, 1.0F - x * x));
        const float pointed = 1.0F - x * x * (1.5F - 0.5F * x);
        share = round + (pointed - round) * shape.pointedness;
    }
    return 0.5F * shape.width * share;
}

}  // namespace

// The centre line is a circular arc in the frame's YZ plane with a total angle of curl_rad.
Frame petal_frame(const Frame& base, const PetalShape& shape, float t) {
    const float angle_rad = shape.curl_rad * t;
    vec3 p{0.0F, shape.length * t, 0.0F};
    if (std::abs(shape.curl_rad) > 1e-3F) {
        const float radius = shape.length / shape.curl_rad;
        p = {0.0F, radius * portable::sin(angle_rad), -radius * (1.0F - portable::cos(angle_rad))};
    }
    return {base.point(p), base.axes * rotation({1, 0, 0}, -angle_rad)};
}

void append_petal(capture::Mesh& mesh, const Frame& base, const PetalShape& shape) {
    Grid grid(shape.columns, shape.rows);
    for (int j = 0; j <= shape.rows; ++j) {
        // Rows are denser towards the tip, where the contour is most curved.
        const double s = static_cast<double>(j) / shape.rows;
        const auto t = j == shape.rows ? 1.0F : static_cast<float>(portable::sin(s * kPi / 2));
        const Frame middle = petal_frame(base, shape, t);
        const float half = half_width(shape, t);
        const float wave =
            portable::sin(2.0F * static_cast<float>(kPi) * shape.ripple_waves * t + shape.ripple_phase_rad);
        for (int i = 0; i <= shape.columns; ++i) {
            const float x = 2.0F * static_cast<float>(i) / static_cast<float>(shape.columns) - 1.0F;
            const float rise = shape.cup * x * x + shape.ripple * wave * x * x * x * t;
            grid.positions[grid.index(i, j)] = middle.point({x * half, 0.0F, rise * half});
            grid.uvs[grid.index(i, j)] = {0.5F * (x + 1.0F), t};
        }
    }
    append_grid(mesh, std::move(grid));
}

}  // namespace rs::synthetic
