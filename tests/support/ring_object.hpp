#pragma once
// Ray-space objects in memory: a ring of cameras with computed images and the encoder's map.

#include "encode/raymap/captured_view.hpp"
#include "encode/raymap/plane_map.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/object/ray_space_object.hpp"
#include "rayspace/object/yuv.hpp"

#include <cmath>
#include <random>

namespace rs::test {

struct RingObjectOptions {
    int views = 12;
    int width = 48;
    int height = 40;
    double distance = 3.5;  // object radii
    double fl_px = 60;
    int planes = 12;
    int x_cells = 256;
    int u_cells = 256;
    double camera_height = 0;  // the cameras stay upright: the principal point moves
    std::uint64_t seed = 1;
};

inline Rig ring_rig(const RingObjectOptions& options) {
    Rig rig = make_ring({.count = options.views,
                         .distance = options.distance,
                         .fl_px = options.fl_px,
                         .width = options.width,
                         .height = options.height});
    for (RigView& view : rig.views) {
        view.camera.world_from_camera[3].y = options.camera_height;
        view.camera.cy -= options.fl_px * options.camera_height / options.distance;
    }
    rig.object_radius = 1;
    return rig;
}

/// Noise in every pixel whose ray passes through the unit cylinder, with all values of alpha; transparent elsewhere.
inline Image<Rgba8> noise_image(const Camera& camera, std::mt19937_64& random) {
    Image<Rgba8> image(camera.width, camera.height);
    for (int x = 0; x < camera.width; ++x) {
        const glm::dvec3 ray = camera.ray(x + 0.5, camera.cy);
        const double across =
            std::abs(ray.x * camera.centre().z - ray.z * camera.centre().x) / std::hypot(ray.x, ray.z);
        if (across > 1) continue;
        for (int y = 2; y < camera.height - 3; ++y) {
            const std::uint64_t bits = random();
            const auto byte = [&](int n) { return static_cast<std::uint8_t>(bits >> (8 * n)); };
            image(x, y) = {byte(0), byte(1), byte(2), byte(4) < 64 ? std::uint8_t{0} : byte(3)};
        }
    }
    return image;
}

/// Makes the middle of every image opaque: half of its columns and rows. Only opaque pixels have detail.
inline void make_middle_opaque(RaySpaceObject& object) {
    for (PlanarImage& image : object.images) {
        for (int row = object.height / 4; row < object.height - object.height / 4; ++row) {
            for (int column = object.width / 4; column < object.width - object.width / 4; ++column) {
                image.a(column, row) = 255;
            }
        }
    }
}

inline RaySpaceObject ring_object(const RingObjectOptions& options) {
    const Rig rig = ring_rig(options);
    RaySpaceObject object;
    object.name = "ring";
    object.rig_json = rig_to_json(rig);
    object.width = options.width;
    object.height = options.height;
    std::mt19937_64 random(options.seed);
    for (const RigView& view : rig.views) {
        object.views.push_back(*encode::captured_view(view.camera, options.planes));
        object.images.push_back(planar_from_rgba(noise_image(view.camera, random)));
    }
    for (const ViewRing& ring : find_rings(rig)) {
        object.rings.push_back(encode::make_plane_map(
            rig, ring, {.planes = options.planes, .x_cells = options.x_cells, .u_cells = options.u_cells}));
    }
    return object;
}

}  // namespace rs::test
