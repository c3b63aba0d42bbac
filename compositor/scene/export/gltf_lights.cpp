#include "compositor/scene/export/gltf_lights.hpp"

#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <cmath>

namespace rs::compositor {
namespace {

using nlohmann::json;

constexpr double kLongestRange = 1e8;  // radii beyond are unlimited
constexpr double kSmallestCone_rad = 1e-3;

// Rotation whose -Z is `towards`, and a translation.
glm::dmat4 world_from_light(const Light& light) {
    const glm::dvec3 back = -glm::normalize(light.towards);
    const glm::dvec3 across = std::abs(back.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(across, back));
    const bool distant = light.kind == LightKind::kDirectional;
    return {glm::dvec4(right, 0), glm::dvec4(glm::cross(back, right), 0), glm::dvec4(back, 0),
            glm::dvec4(distant ? glm::dvec3(0) : light.location, 1)};
}

// Factor of `colour` in candela: exact for attenuation by the square of the distance, else matched at one distance.
double inverse_square_factor(const Light& light, double distance) {
    const glm::dvec3 a(light.attenuation);
    if (a.x == 0 && a.y == 0 && a.z > 0) return 1 / a.z;
    return distance * distance /
           std::max<double>(a.x + a.y * distance + a.z * distance * distance, light.least_attenuation);
}

}  // namespace

GltfLight gltf_light(const Light& given, double reach) {
    GltfLight made;
    const Light light = to_punctual_light(given);
    const std::string name = given.name.empty() ? "light" : given.name;
    if (light.kind != given.kind) made.warnings.push_back(name + ": becomes a spot; glTF has no such light");
    const bool distant = light.kind == LightKind::kDirectional;
    double factor = kPi;  // of a white diffuse surface (light.hpp)
    if (!distant) {
        const double matched_at = std::min(light.radius, reach) / 3;
        factor *= inverse_square_factor(light, matched_at);
        if (light.attenuation.x != 0 || light.attenuation.y != 0 || light.attenuation.z <= 0) {
            made.warnings.push_back(name + ": its attenuation becomes the inverse square of the distance");
        }
    }
    const float peak = std::max({light.colour.r, light.colour.g, light.colour.b, 1e-6F});
    const glm::dvec3 colour(light.colour / peak);
    made.light = {{"type", distant                          ? "directional"
                           : light.kind == LightKind::kSpot ? "spot"
                                                            : "point"},
                  {"name", name},
                  {"color", {colour.r, colour.g, colour.b}},
                  {"intensity", factor * peak}};
    if (!distant && light.radius < kLongestRange) made.light["range"] = light.radius;
    if (light.kind == LightKind::kSpot) {
        const double outer = std::clamp(light.cut_off_rad, kSmallestCone_rad, kPi / 2);
        const double inner = std::clamp(light.beam_width_rad, 0.0, outer * 0.999);
        made.light["spot"] = {{"innerConeAngle", inner}, {"outerConeAngle", outer}};
    }
    json extras = {{"ambient", {light.ambient.r, light.ambient.g, light.ambient.b}},
                   {"everywhere", light.everywhere},
                   {"castsShadows", light.casts_shadows}};
    const bool inverse_square = light.attenuation.x == 0 && light.attenuation.y == 0 && light.attenuation.z > 0;
    if (!distant) extras["leastAttenuation"] = inverse_square ? light.least_attenuation / light.attenuation.z : 1;
    made.light["extras"]["RaySpaceLight"] = std::move(extras);
    made.world_from_light = world_from_light(light);
    return made;
}

}  // namespace rs::compositor
