#pragma once
// A ray-space object of exactly known shape: a ball beside the axis with a grey texture, ray-cast into the images and
// the shape map of a ring_object(), by the formulas of rayspace/api/types/shape_map.hpp.

#include "rayspace/geometry/ray_space.hpp"
#include "tests/support/ring_object.hpp"

#include <algorithm>
#include <optional>

namespace rs::test {

struct Sphere {
    glm::dvec3 centre{0.12, 0.08, 0.2};
    double radius = 0.6;
};

struct SphereHit {
    double enters = 0;  // distances from `from`, in lengths of `direction`
    double leaves = 0;
};

inline std::optional<SphereHit> hit(const Sphere& sphere, const glm::dvec3& from, const glm::dvec3& direction) {
    const glm::dvec3 to_centre = sphere.centre - from;
    const double square = glm::dot(direction, direction);
    const double nearest = glm::dot(to_centre, direction) / square;
    const double rest = (sphere.radius * sphere.radius - glm::dot(to_centre, to_centre)) / square + nearest * nearest;
    if (rest < 0) return std::nullopt;
    return SphereHit{nearest - std::sqrt(rest), nearest + std::sqrt(rest)};
}

/// A smooth texture without repetition on one side of the ball.
inline double grey_at(const glm::dvec3& p) {
    return 128 + 55 * std::sin(5 * p.x + 1) * std::cos(4 * p.z) + 55 * std::sin(6 * p.y + 2 * p.x);
}

inline Image<Rgba8> sphere_image(const Sphere& sphere, const Camera& camera) {
    Image<Rgba8> image(camera.width, camera.height);
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            const glm::dvec3 ray = camera.ray(x + 0.5, y + 0.5);
            const auto met = hit(sphere, camera.centre(), ray);
            if (!met) continue;
            const auto grey = static_cast<std::uint8_t>(std::lround(grey_at(camera.centre() + met->enters * ray)));
            image(x, y) = {grey, grey, grey, 255};
        }
    }
    return image;
}

/// Numbers, gaps and normal lines of a shape map for the ring of `rig`; all cells empty.
inline ShapeMap empty_shape(const Rig& rig, const Ring& ring, int lines, int p_cells, int bands) {
    const auto fixed = [](double value, int bits) {
        return static_cast<std::int32_t>(std::lround(std::ldexp(value, bits)));
    };
    const double half = 1 + 1.0 / 32;
    const glm::dvec3 first = rig.views.front().camera.centre();
    ShapeMap shape;
    shape.p_cells = p_cells;
    shape.bands = bands;
    shape.p_half_q20 = fixed(half, 20);
    shape.p_cells_per_unit_q12 = fixed(p_cells / (2 * half), 12);
    shape.h_low_q20 = fixed(-half, 20);
    shape.bands_per_unit_q12 = fixed(bands / (2 * half), 12);
    shape.reference_distance_q20 = fixed(std::hypot(first.x, first.z), 20);
    shape.reference_height_q20 = fixed(first.y, 20);
    shape.depth_low_q20 = fixed(-half, 20);
    shape.depth_step_q24 = fixed(2 * half / 255, 24);
    shape.jump = 20;
    shape.thickness = 8;
    for (std::size_t n = 0; n < rig.views.size(); ++n) {
        const Camera& camera = rig.views[n].camera;
        shape.gaps.push_back(
            {static_cast<std::uint16_t>(lines), static_cast<std::uint32_t>(n) * static_cast<std::uint32_t>(lines)});
        for (int k = 0; k < ring.planes; ++k) {
            const ReferencePlane plane = reference_plane(k, ring.planes);
            const ViewpointLine line = viewpoint_line(camera.centre(), plane);
            shape.normal_lines.push_back({fixed(glm::dot(plane.normal, camera.forward()), 30),
                                          fixed(glm::dot(plane.normal, camera.right()) * camera.fl_x, 16),
                                          fixed(line.a, 20), fixed(line.c, 20)});
        }
    }
    shape.cells.resize(rig.views.size() * static_cast<std::size_t>(lines * p_cells * bands));
    return shape;
}

/// The ray of a cell's centre: from the foot, one radius of horizontal length. The parallel captured rays pass the axis
/// at D sin(phi - alpha), where alpha is the azimuth of the ray's origin; p is therefore D times a weighted sum of two
/// sines, which is again a sine.
struct CellRay {
    glm::dvec3 foot;
    glm::dvec3 direction;
};
inline CellRay cell_ray(const Rig& rig, std::size_t gap, double fraction, double p, double h) {
    const glm::dvec3 first = rig.views[gap].camera.centre();
    const glm::dvec3 second = rig.views[(gap + 1) % rig.views.size()].camera.centre();
    const glm::dvec3 between = (1 - fraction) * first + fraction * second;
    const double alpha = std::atan2(between.x, between.z) - std::asin(p / std::hypot(between.x, between.z));
    const double rho = std::sqrt(first.x * first.x + first.z * first.z - p * p);
    return {{p * std::cos(alpha), h, -p * std::sin(alpha)}, {-std::sin(alpha), (h - first.y) / rho, -std::cos(alpha)}};
}

/// Draws the ball's shape map. Rays that miss the ball by less than a cell get the depth of its rim.
inline ShapeMap sphere_shape(const Sphere& sphere, const Rig& rig, const Ring& ring, int lines, int p_cells,
                             int bands) {
    ShapeMap shape = empty_shape(rig, ring, lines, p_cells, bands);
    const double half = std::ldexp(shape.p_half_q20, -20);
    const Sphere wider{sphere.centre, sphere.radius + 2 * half / std::min(p_cells, bands)};
    const auto level = [&](double depth) {
        return static_cast<std::uint8_t>(std::clamp(std::lround((depth + half) / (2 * half) * 255), 0L, 255L));
    };
    std::size_t at = 0;
    for (std::size_t gap = 0; gap < rig.views.size(); ++gap) {
        for (int s = 0; s < lines; ++s) {
            for (int pi = 0; pi < p_cells; ++pi) {
                for (int hi = 0; hi < bands; ++hi, ++at) {
                    const double p = -half + (pi + 0.5) * 2 * half / p_cells;
                    const double h = -half + (hi + 0.5) * 2 * half / bands;
                    const CellRay ray = cell_ray(rig, gap, (s + 0.5) / lines, p, h);
                    const auto near = hit(wider, ray.foot, ray.direction);
                    if (!near) continue;
                    const double middle = (near->enters + near->leaves) / 2;
                    const SphereHit met = hit(sphere, ray.foot, ray.direction).value_or(SphereHit{middle, middle});
                    shape.cells[at] = {level(met.enters), ShapeCell::kByBoth};
                }
            }
        }
    }
    return shape;
}

/// Options of a ring whose images are large enough for the ball's texture.
inline RingObjectOptions sphere_options() {
    return {.views = 36, .width = 128, .height = 128, .fl_px = 200, .camera_height = 0.3};
}

inline RaySpaceObject sphere_object(const RingObjectOptions& options, const Sphere& sphere) {
    RaySpaceObject object = ring_object(options);
    const Rig rig = ring_rig(options);
    for (std::size_t n = 0; n < rig.views.size(); ++n) {
        object.images[n] = planar_from_rgba(sphere_image(sphere, rig.views[n].camera));
    }
    object.rings[0].shape = sphere_shape(sphere, rig, object.rings[0], 4, 64, 64);
    return object;
}

/// An upright camera with the ring's intrinsics at a horizontal position, directed at the axis.
inline Camera upright_at(const RingObjectOptions& options, const glm::dvec3& centre) {
    Camera camera = upright_camera(look_at_camera(centre, {0, centre.y, 0}, 1, options.width, options.height));
    const double distance = std::hypot(centre.x, centre.z);
    camera.fl_x = camera.fl_y = options.fl_px * distance / options.distance;
    camera.cx = options.width / 2.0;
    camera.cy = options.height / 2.0 - camera.fl_y * centre.y / distance;
    return camera;
}

/// A camera on the straight line between the viewpoints of views n and n + 1, where all rays have about the same
/// weight.
inline Camera between_views(const RingObjectOptions& options, std::size_t n, double fraction) {
    const Rig rig = ring_rig(options);
    return upright_at(options, (1 - fraction) * rig.views[n].camera.centre() +
                                   fraction * rig.views[(n + 1) % rig.views.size()].camera.centre());
}

}  // namespace rs::test
