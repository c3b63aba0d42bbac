#pragma once
// Random ring objects with shape maps, and cameras that view them, to compare renderers.

#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/ray_space.hpp"
#include "tests/support/random.hpp"
#include "tests/support/random_shape.hpp"
#include "tests/support/ring_object.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace rs::test {

/// Poses of views, relative to the ring of captured ones.
enum class Pose { on_ring, at_captured_view, upright, tilted };

inline RingObjectOptions random_options(Random& random) {
    RingObjectOptions options;
    options.views = random.whole(1, 16);
    options.width = random.whole(1, 50);
    options.height = random.whole(6, 50);
    options.distance = random.real(1.5, 8);
    options.fl_px = options.width * options.distance * random.real(0.3, 0.8);
    options.planes = random.whole(3, 14);
    options.x_cells = random.whole(1, 80);
    options.u_cells = random.whole(1, 80);
    options.camera_height = random.real(-0.5, 0.5);
    options.seed = random.engine();
    return options;
}

inline RaySpaceObject random_object(Random& random, const RingObjectOptions& options) {
    RaySpaceObject object = ring_object(options);
    if (random.whole(0, 1) == 0) make_middle_opaque(object);
    const double empty_share = random.whole(0, 3) == 0 ? 0.9 : random.real(0, 0.5);
    for (std::size_t r = 0; r < object.rings.size(); ++r) {
        object.rings[r].shape = random_shape(object, r, random.engine, empty_share);
    }
    return object;
}

inline Camera shape_camera(Random& random, const RingObjectOptions& options, Pose pose) {
    constexpr std::array kWidths = {1, 2, 15, 16, 17, 31, 33, 48, 65};
    if (pose == Pose::at_captured_view) {
        return ring_rig(options).views[static_cast<std::size_t>(random.whole(0, options.views - 1))].camera;
    }
    const bool free = pose != Pose::on_ring;
    const double angle = random.real(0, 2 * kPi);
    const double distance = free ? random.real(0.3, 12) : options.distance;
    const double height = free ? random.real(-1, 1) : options.camera_height;
    const glm::dvec3 eye(distance * std::sin(angle), height, distance * std::cos(angle));
    const double fov = free ? radians(random.real(5, 100)) : 2 * std::atan(random.real(0.5, 1.4) / distance);
    const glm::dvec3 at(random.real(-0.2, 0.2), pose == Pose::tilted ? random.real(-1, 1) : eye.y,
                        random.real(-0.2, 0.2));
    Camera camera =
        look_at_camera(eye, at, fov, kWidths[static_cast<std::size_t>(random.whole(0, 8))], random.whole(1, 60));
    if (pose == Pose::tilted) return camera;
    camera = upright_camera(camera);
    camera.cy += random.real(-10, 10);
    if (!free) camera.cy -= camera.fl_y * height / distance;
    if (random.whole(0, 9) == 0) {  // upside down: rotated by 180 degrees about the viewing axis
        camera.world_from_camera[0] = -camera.world_from_camera[0];
        camera.world_from_camera[1] = -camera.world_from_camera[1];
    }
    return camera;
}

}  // namespace rs::test
