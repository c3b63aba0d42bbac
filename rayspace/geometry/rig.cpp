#include "rayspace/geometry/rig.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/file/file_reference.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace rs {
namespace fs = std::filesystem;
namespace {

constexpr double kRingGap_rad = radians(5);

}  // namespace

fs::path image_path(const fs::path& folder, const RigView& view) {
    fs::path as_given = folder / view.file_path;
    std::error_code ignored;
    if (fs::is_regular_file(as_given, ignored)) return as_given;
    fs::path with_extension = as_given;
    with_extension += ".png";
    if (fs::is_regular_file(with_extension, ignored)) return with_extension;
    for (const char* extension : {"", ".png"}) {
        const auto resolved = resolve_reference(view.file_path + extension, folder);
        if (resolved && fs::is_regular_file(*resolved, ignored)) return *resolved;
    }
    // If none exists, the name that a reader would try, for its error message.
    return as_given.has_extension() ? as_given : with_extension;
}

Rig make_ring(const RingOptions& options) {
    RS_CHECK(options.count >= 1 && options.count <= kMaxViews);
    RS_CHECK(options.distance > 0 && options.fl_px > 0);
    RS_CHECK(std::abs(options.elevation_rad) < kPi / 2);
    const glm::dvec3 target(0, options.look_at_height, 0);
    const double fov_x_rad = 2 * std::atan(options.width / (2 * options.fl_px));
    Rig rig;
    rig.views.reserve(static_cast<std::size_t>(options.count));
    for (int i = 0; i < options.count; ++i) {
        const double turn_rad = options.first_rad + 2 * kPi * i / options.count;
        const glm::dvec3 direction(std::cos(options.elevation_rad) * std::sin(turn_rad),
                                   std::sin(options.elevation_rad),
                                   std::cos(options.elevation_rad) * std::cos(turn_rad));
        RigView view;
        char name[32];
        std::snprintf(name, sizeof name, "images/%04d.png", i);
        view.file_path = name;
        view.camera =
            look_at_camera(target + options.distance * direction, target, fov_x_rad, options.width, options.height);
        // The given value, without a round trip through the angle.
        view.camera.fl_x = options.fl_px;
        view.camera.fl_y = options.fl_px;
        rig.views.push_back(std::move(view));
    }
    return rig;
}

std::vector<ViewRing> find_rings(const Rig& rig) {
    const auto centre = [&](int i) { return rig.views[static_cast<std::size_t>(i)].camera.centre(); };
    const auto elevation = [&](int i) { return std::atan2(centre(i).y, std::hypot(centre(i).x, centre(i).z)); };
    const auto azimuth = [&](int i) {
        // Angles slightly below zero count as zero, so that a ring whose first camera is on +Z starts with it.
        const double angle = std::atan2(centre(i).x, centre(i).z);
        return angle < -1e-9 ? angle + 2 * kPi : angle;
    };

    std::vector<int> by_elevation(rig.views.size());
    std::iota(by_elevation.begin(), by_elevation.end(), 0);
    std::stable_sort(by_elevation.begin(), by_elevation.end(),
                     [&](int a, int b) { return elevation(a) < elevation(b); });

    std::vector<ViewRing> rings;
    for (std::size_t n = 0; n < by_elevation.size(); ++n) {
        if (n == 0 || elevation(by_elevation[n]) - elevation(by_elevation[n - 1]) > kRingGap_rad) rings.emplace_back();
        rings.back().views.push_back(by_elevation[n]);
        rings.back().elevation_rad += elevation(by_elevation[n]);
    }
    for (ViewRing& ring : rings) {
        ring.elevation_rad /= static_cast<double>(ring.views.size());
        std::stable_sort(ring.views.begin(), ring.views.end(), [&](int a, int b) { return azimuth(a) < azimuth(b); });
    }
    return rings;
}

}  // namespace rs
