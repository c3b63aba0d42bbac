#include "engine/core/views/compare.hpp"

#include "engine/core/definition/reconstruct.hpp"
#include "engine/core/fast/renderer.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/codec/stream/decode_image.hpp"
#include "rayspace/geometry/ray_space.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

namespace rs::engine {
namespace {

// mt19937_64 gives the same numbers on every platform; the standard distributions do not.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double in(double low, double high) {
        return low + (high - low) * std::ldexp(static_cast<double>(engine_() >> 11), -53);
    }

private:
    std::mt19937_64 engine_;
};

enum class Pose { upright, on_ring, tilted };

// Position of the views of a ring, in object radii.
struct RingPosition {
    double distance = 0;
    double height = 0;
};

RingPosition random_ring_position(const RaySpaceObject& object, Random& random) {
    const auto rings = static_cast<double>(object.rings.size());
    const Ring& ring = object.rings[std::min(static_cast<std::size_t>(random.in(0, rings)), object.rings.size() - 1)];
    const auto place = [](std::int32_t distance_q20, std::int32_t height_q20) {
        return RingPosition{std::ldexp(distance_q20, -20), std::ldexp(height_q20, -20)};
    };
    if (!ring.shape.empty()) return place(ring.shape.reference_distance_q20, ring.shape.reference_height_q20);
    const CapturedView& view = object.views[ring.views.front()];
    return place(std::abs(view.lines.front().l0_q20), view.height_q20);  // the axis' depth
}

// One random number per statement, since the evaluation order of arguments is unspecified.
Camera random_camera(const RaySpaceObject& object, Random& random, Pose pose) {
    const double azimuth = random.in(0, 2 * kPi);
    double distance = random.in(1.2, 12);
    double eye_height = random.in(-1, 1);
    double at_height = random.in(-0.5, 0.5);
    const double at_x = random.in(-0.3, 0.3);
    const double at_z = random.in(-0.3, 0.3);
    if (pose == Pose::on_ring) {
        const RingPosition place = random_ring_position(object, random);
        distance = place.distance;
        eye_height = place.height;
        at_height = 0;
    }
    const double half_extent = random.in(0.3, 1.6);  // of the larger side, radii at the axis
    const int width = static_cast<int>(random.in(16, 256));
    const int height = static_cast<int>(random.in(16, 256));
    const glm::dvec3 eye(distance * std::sin(azimuth), eye_height, distance * std::cos(azimuth));
    const glm::dvec3 at(at_x, pose == Pose::upright ? eye_height : at_height, at_z);
    const double fov_x = 2 * std::atan(half_extent / distance * width / std::max(width, height));
    const Camera camera =
        look_at_camera(eye * object.units_per_radius, at * object.units_per_radius, fov_x, width, height);
    if (pose == Pose::tilted) return camera;
    Camera upright = upright_camera(camera);
    if (pose == Pose::on_ring) upright.cy -= upright.fl_y * eye_height / distance;  // keeps the object centred
    return upright;
}

}  // namespace

Result<ConformanceReport> check_conformance(RaySpaceObject object, int views, std::uint64_t seed, Progress* progress) {
    RS_TRY(substitute_missing_images(object));
    RS_ASSIGN_OR_RETURN(const Renderer renderer, Renderer::create(object));
    if (has_only_coded_images(object)) {  // the scalar definition needs unpacked images
        object.images.resize(object.views.size());
        codec::decode_images(object);
    }

    ConformanceReport report;
    Random random(seed);
    if (progress != nullptr) progress->start("comparing", views);
    for (int n = 0; n < views; ++n) {
        constexpr Pose kPoses[] = {Pose::upright, Pose::on_ring, Pose::upright, Pose::tilted};
        const Pose pose = kPoses[n % 4];
        const Camera camera = random_camera(object, random, pose);
        RS_ASSIGN_OR_RETURN(const ViewRegisters registers,
                            prepare_view(object, camera, static_cast<TexelFilter>(n % 3)));
        Image<Rgba8> defined(camera.width, camera.height);
        Image<Rgba8> rendered(camera.width, camera.height);
        Image<std::int32_t> defined_depth(camera.width, camera.height);
        Image<std::int32_t> rendered_depth(camera.width, camera.height);
        reconstruct_scalar(object, registers, defined, defined_depth);
        renderer.render(registers, rendered, rendered_depth);
        ++report.views;
        report.upright_views += registers.upright();
        report.on_ring_views += pose == Pose::on_ring;
        report.pixels += std::int64_t{camera.width} * camera.height;
        for (std::size_t i = 0; i < defined.pixels().size(); ++i) {
            report.object_pixels += defined.pixels()[i].a != 0;
            report.different_pixels += !(defined.pixels()[i] == rendered.pixels()[i]) ||
                                       defined_depth.pixels()[i] != rendered_depth.pixels()[i];
        }
        if (progress != nullptr) progress->advance();
    }
    if (progress != nullptr) progress->finish();
    return report;
}

}  // namespace rs::engine
