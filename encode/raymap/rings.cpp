#include "encode/raymap/rings.hpp"

#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rs::encode {
namespace {

constexpr double kRingGap_rad = radians(5);

}  // namespace

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

}  // namespace rs::encode
