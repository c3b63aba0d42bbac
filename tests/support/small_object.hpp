#pragma once
// A small valid ray-space object, computed from the formulas of encode/FORMAT.md without the encoder.

#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace rs::test {

struct SmallObjectOptions {
    int rings = 1;
    int views_per_ring = 8;
    int planes = 4;
    int x_cells = 16;
    int u_cells = 16;
    int width = 12;
    int height = 10;
    double distance = 3.5;  // object radii
};

namespace small_object_detail {

inline std::int32_t fixed(double value, int fractional_bits) {
    return static_cast<std::int32_t>(std::lround(std::ldexp(value, fractional_bits)));
}

inline glm::dvec3 tangent(int plane, int planes) {
    const double t = 2 * kPi * plane / planes;
    return {std::cos(t), 0, -std::sin(t)};
}

inline CapturedView captured(const Camera& camera, int planes) {
    CapturedView view{
        fixed(camera.cx, 16), fixed(camera.cy, 16), fixed(camera.fl_y, 16), fixed(camera.centre().y, 20), {}};
    for (int k = 0; k < planes; ++k) {
        const glm::dvec3 t = tangent(k, planes);
        view.lines.push_back({fixed(-glm::dot(camera.centre(), camera.forward()), 20),
                              fixed(glm::dot(t, camera.forward()), 30),
                              fixed(-glm::dot(camera.centre(), camera.right()) * camera.fl_x, 16),
                              fixed(glm::dot(t, camera.right()) * camera.fl_x, 16)});
    }
    return view;
}

inline PlanarImage image(int width, int height, unsigned seed) {
    const auto filled = [&](int w, int h, unsigned salt) {
        Image<std::uint8_t> plane(w, h);
        unsigned state = seed * 7919U + salt;
        for (std::uint8_t& sample : plane.pixels()) {
            state = state * 1664525U + 1013904223U;
            sample = static_cast<std::uint8_t>(state >> 24U);
        }
        return plane;
    };
    return {filled(width, height, 1), filled(half_size(width), half_size(height), 2),
            filled(half_size(width), half_size(height), 3), filled(width, height, 4)};
}

/// The view of the ring in front of the plane whose ray through x is nearest to u, with x in front of the camera.
inline std::uint16_t nearest_view(const std::vector<Camera>& cameras, std::uint16_t first, int plane, int planes,
                                  double x, double u) {
    const glm::dvec3 t = tangent(plane, planes);
    const glm::dvec3 normal(-t.z, 0, t.x);
    std::uint16_t best = kNoImage;
    double best_distance = 1e9;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const double a = glm::dot(cameras[i].centre(), t);
        const double c = glm::dot(cameras[i].centre(), normal);
        if (c < 0.1 || glm::dot(x * t - cameras[i].centre(), cameras[i].forward()) < 0.125) continue;
        const double distance = std::abs((x - a) / c - u);
        if (distance < best_distance) {
            best_distance = distance;
            best = static_cast<std::uint16_t>(first + i);
        }
    }
    return best;
}

}  // namespace small_object_detail

/// Ring r has the views r * views_per_ring + 0, 1, ...: upright cameras at height r / 4, directed at the Y axis.
inline RaySpaceObject small_object(const SmallObjectOptions& options = {}) {
    using namespace small_object_detail;
    RaySpaceObject object;
    object.name = "small";
    object.units_per_radius = 2.5;
    object.width = options.width;
    object.height = options.height;
    Rig rig;
    for (int r = 0; r < options.rings; ++r) {
        RingOptions ring_options;
        ring_options.count = options.views_per_ring;
        ring_options.distance = options.distance;
        ring_options.look_at_height = r / 4.0;
        ring_options.fl_px = options.width * 1.2;
        ring_options.width = options.width;
        ring_options.height = options.height;
        const Rig ring_rig = make_ring(ring_options);

        Ring ring;
        ring.elevation_udeg =
            static_cast<std::int32_t>(std::lround(degrees(std::atan2(r / 4.0, options.distance)) * 1e6));
        ring.planes = options.planes;
        ring.x_cells = options.x_cells;
        ring.u_cells = options.u_cells;
        const double x_half = 1.01 / std::cos(kPi / options.planes);
        const double u_half = 1.01 * std::tan(kPi / options.planes);
        ring.x_half_q20 = fixed(x_half, 20);
        ring.x_cells_per_unit_q12 = fixed(options.x_cells / (2 * x_half), 12);
        ring.u_half_q28 = fixed(u_half, 28);
        ring.u_cells_per_unit_q12 = fixed(options.u_cells / (2 * u_half), 12);

        const auto first = static_cast<std::uint16_t>(object.views.size());
        std::vector<Camera> cameras;
        for (const RigView& view : ring_rig.views) {
            const auto index = static_cast<std::uint16_t>(object.views.size());
            cameras.push_back(view.camera);
            ring.views.push_back(index);
            object.views.push_back(captured(view.camera, options.planes));
            object.images.push_back(image(options.width, options.height, index));
            rig.views.push_back(view);
        }
        for (int k = 0; k < options.planes; ++k) {
            for (int xi = 0; xi < options.x_cells; ++xi) {
                const double x = -x_half + (xi + 0.5) * 2 * x_half / options.x_cells;
                for (int ui = 0; ui < options.u_cells; ++ui) {
                    const double u = -u_half + (ui + 0.5) * 2 * u_half / options.u_cells;
                    ring.cells.push_back(nearest_view(cameras, first, k, options.planes, x, u));
                }
            }
        }
        object.rings.push_back(std::move(ring));
    }
    object.rig_json = rig_to_json(rig);
    return object;
}

}  // namespace rs::test
