#pragma once
// A small valid shape map for a ring of a small object (small_object.hpp): two balls, one partly occluding the other,
// computed from the formulas of encode/FORMAT.md.

#include "tests/support/small_object.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace rs::test {

struct SmallShapeOptions {
    int p_cells = 9;
    int bands = 7;
    std::vector<int> lines = {2};  // per gap, repeated
};

namespace small_shape_detail {

struct Ball {
    glm::dvec3 centre;
    double radius;
};

/// Distance along the ray to the ball.
inline std::optional<double> entry(const Ball& ball, const glm::dvec3& from, const glm::dvec3& direction) {
    const glm::dvec3 to_centre = ball.centre - from;
    const double nearest = glm::dot(to_centre, direction);
    const double square = ball.radius * ball.radius - glm::dot(to_centre, to_centre) + nearest * nearest;
    if (square <= 0) return std::nullopt;
    return nearest - std::sqrt(square);
}

inline NormalLine normal_line(const Camera& camera, int plane, int planes) {
    using small_object_detail::fixed;
    const glm::dvec3 t = small_object_detail::tangent(plane, planes);
    const glm::dvec3 normal(-t.z, 0, t.x);
    return {fixed(glm::dot(normal, camera.forward()), 30), fixed(glm::dot(normal, camera.right()) * camera.fl_x, 16),
            fixed(glm::dot(camera.centre(), t), 20), fixed(glm::dot(camera.centre(), normal), 20)};
}

/// First hit of the ray through `foot`.
inline ShapeCell cell(const ShapeMap& shape, const glm::dvec3& foot, const glm::dvec3& direction) {
    const Ball balls[] = {{{0.1, 0, -0.15}, 0.7}, {{0.2, 0.1, 0.6}, 0.3}};
    std::optional<double> nearest;
    for (const Ball& ball : balls) {
        const auto depth = entry(ball, foot, direction);
        if (depth && (!nearest || *depth < *nearest)) nearest = depth;
    }
    if (!nearest) return {};
    const double steps = (*nearest - std::ldexp(shape.depth_low_q20, -20)) / std::ldexp(shape.depth_step_q24, -24);
    const auto depth = static_cast<std::uint8_t>(std::clamp(std::lround(steps), 0L, 255L));
    return {depth, ShapeCell::kByBoth};
}

}  // namespace small_shape_detail

/// `object` is a small_object() with its rig.
inline ShapeMap small_shape(const RaySpaceObject& object, std::size_t ring_index,
                            const SmallShapeOptions& options = {}) {
    using small_object_detail::fixed;
    const Ring& ring = object.rings[ring_index];
    const Rig rig = rig_from_json(object.rig_json, "small object").value();
    const double p_half = 1.02;
    const double band_height = 2.1 / options.bands;
    ShapeMap shape;
    shape.p_cells = options.p_cells;
    shape.bands = options.bands;
    shape.p_half_q20 = fixed(p_half, 20);
    shape.p_cells_per_unit_q12 = fixed(options.p_cells / (2 * p_half), 12);
    shape.h_low_q20 = fixed(-1.05, 20);
    shape.bands_per_unit_q12 = fixed(1 / band_height, 12);
    const glm::dvec3 first = rig.views[ring.views.front()].camera.centre();
    shape.reference_distance_q20 = fixed(std::hypot(first.x, first.z), 20);
    shape.reference_height_q20 = fixed(first.y, 20);
    shape.depth_low_q20 = fixed(-1.02, 20);
    shape.depth_step_q24 = fixed(2 * 1.02 / 255, 24);
    shape.jump = 20;
    shape.thickness = 9;
    std::uint32_t line = 0;
    for (std::size_t n = 0; n < ring.views.size(); ++n) {
        const Camera& camera = rig.views[ring.views[n]].camera;
        const int lines = options.lines[n % options.lines.size()];
        shape.gaps.push_back({static_cast<std::uint16_t>(lines), line});
        line += static_cast<std::uint32_t>(lines);
        for (int k = 0; k < ring.planes; ++k) {
            shape.normal_lines.push_back(small_shape_detail::normal_line(camera, k, ring.planes));
        }
        const double azimuth = std::atan2(camera.centre().x, camera.centre().z);
        const double gap = 2 * kPi / static_cast<double>(ring.views.size());
        for (int s = 0; s < lines; ++s) {
            const double angle = azimuth + gap * (s + 0.5) / lines;
            const glm::dvec3 direction(-std::sin(angle), 0, -std::cos(angle));
            for (int pi = 0; pi < options.p_cells; ++pi) {
                const double p = -p_half + (pi + 0.5) * 2 * p_half / options.p_cells;
                for (int hi = 0; hi < options.bands; ++hi) {
                    const glm::dvec3 foot(p * std::cos(angle), -1.05 + (hi + 0.5) * band_height, -p * std::sin(angle));
                    shape.cells.push_back(small_shape_detail::cell(shape, foot, direction));
                }
            }
        }
    }
    return shape;
}

inline RaySpaceObject small_object_with_shape(const SmallObjectOptions& object_options = {},
                                              const SmallShapeOptions& shape_options = {}) {
    RaySpaceObject object = small_object(object_options);
    for (std::size_t r = 0; r < object.rings.size(); ++r) {
        object.rings[r].shape = small_shape(object, r, shape_options);
    }
    return object;
}

}  // namespace rs::test
