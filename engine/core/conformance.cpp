#include "engine/core/conformance.hpp"

#include "engine/core/reconstruct.hpp"
#include "engine/core/renderer.hpp"
#include "rayspace/conventions.hpp"
#include "rayspace/ray_space.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace rs::engine {
namespace {

// mt19937_64 is the same everywhere; the standard distributions are not.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double in(double low, double high) {
        return low + (high - low) * std::ldexp(static_cast<double>(engine_() >> 11), -53);
    }

private:
    std::mt19937_64 engine_;
};

// One random number to a statement: the order of a call's arguments is the compiler's choice.
Camera random_camera(const RaySpaceObject& object, Random& random, bool upright) {
    const double azimuth = random.in(0, 2 * kPi);
    const double distance = random.in(1.2, 12);
    const double eye_height = random.in(-1, 1);
    const double at_x = random.in(-0.3, 0.3);
    const double at_height = random.in(-0.5, 0.5);
    const double at_z = random.in(-0.3, 0.3);
    const double half_extent = random.in(0.3, 1.6);  // of the larger side, in radii at the axis
    const int width = static_cast<int>(random.in(16, 256));
    const int height = static_cast<int>(random.in(16, 256));
    const glm::dvec3 eye(distance * std::sin(azimuth), eye_height, distance * std::cos(azimuth));
    const glm::dvec3 at(at_x, upright ? eye_height : at_height, at_z);
    const double fov_x = 2 * std::atan(half_extent / distance * width / std::max(width, height));
    const Camera camera =
        look_at_camera(eye * object.units_per_radius, at * object.units_per_radius, fov_x, width, height);
    return upright ? upright_camera(camera) : camera;
}

}  // namespace

Result<ConformanceReport> check_conformance(RaySpaceObject object, int views, std::uint64_t seed, Progress* progress) {
    if (const Status status = substitute_missing_pictures(object); !status) return status.error();
    const Result<Renderer> renderer = Renderer::create(object);
    if (!renderer) return renderer.error();

    ConformanceReport report;
    Random random(seed);
    if (progress != nullptr) progress->start("comparing", views);
    for (int n = 0; n < views; ++n) {
        const Camera camera = random_camera(object, random, n % 4 != 3);
        const Result<ViewRegisters> registers = prepare_view(object, camera);
        if (!registers) return registers.error();
        Image<Rgba8> defined(camera.width, camera.height);
        Image<Rgba8> rendered(camera.width, camera.height);
        reconstruct_scalar(object, *registers, defined);
        renderer->render(*registers, rendered);
        ++report.views;
        report.upright_views += registers->upright();
        report.pixels += std::int64_t{camera.width} * camera.height;
        for (std::size_t i = 0; i < defined.pixels().size(); ++i) {
            report.object_pixels += defined.pixels()[i].a != 0;
            report.different_pixels += !(defined.pixels()[i] == rendered.pixels()[i]);
        }
        if (progress != nullptr) progress->advance();
    }
    if (progress != nullptr) progress->finish();
    return report;
}

}  // namespace rs::engine
