#include "compositor/scene/surroundings.hpp"

#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <cmath>

namespace rs::compositor {
namespace {

glm::vec3 gradient(const std::vector<glm::vec3>& colours, const std::vector<double>& angles_rad, double angle_rad) {
    double before = 0;
    for (std::size_t i = 0; i < angles_rad.size() && i + 1 < colours.size(); ++i) {
        if (angle_rad <= angles_rad[i]) {
            const double width = angles_rad[i] - before;
            const auto t = static_cast<float>(width > 0 ? (angle_rad - before) / width : 1);
            return colours[i] * (1 - t) + colours[i + 1] * t;
        }
        before = angles_rad[i];
    }
    return colours[std::min(angles_rad.size(), colours.size() - 1)];
}

}  // namespace

glm::vec3 background_colour(const Background& background, const glm::dvec3& direction) {
    const glm::dvec3 d = glm::normalize(glm::transpose(background.world_from_background) * direction);
    const double from_zenith = std::acos(std::clamp(d.y, -1.0, 1.0));
    const double from_nadir = kPi - from_zenith;
    if (!background.ground.empty() && !background.ground_angles_rad.empty() &&
        from_nadir <= background.ground_angles_rad.back()) {
        return gradient(background.ground, background.ground_angles_rad, from_nadir);
    }
    return gradient(background.sky, background.sky_angles_rad, from_zenith);
}

float fog_transmittance(const Fog& fog, double distance) {
    if (distance >= fog.visibility) return 0;
    const double left = fog.visibility - distance;
    return static_cast<float>(fog.kind == FogKind::kLinear ? left / fog.visibility : std::exp(-distance / left));
}

}  // namespace rs::compositor
