#include "compositor/viewer/residency/object_relighting.hpp"

#include "rayspace/light/light_model.hpp"

#include <algorithm>
#include <cmath>

namespace rs::compositor {
namespace {

constexpr float kMaxGain = 4;
constexpr float kLeastCaptureShare = 0.05F;  // of the mean irradiance, so that unlit sides do not get all the gain

}  // namespace

glm::dvec3 middle_of(const PlacedObject& placed) {
    return placed.world_from_object.point(normal_proxy(*placed.object).centre);
}

const IrradianceHarmonics* nearest_irradiance(const LocalIrradiances& all, const PlacedObject& placed) {
    const glm::dvec3 position = middle_of(placed);
    const auto nearest = std::ranges::min_element(
        all, {}, [&](const LocalIrradiance& local) { return glm::distance(local.position, position); });
    return nearest == all.end() ? nullptr : &nearest->irradiance;
}

IrradianceHarmonics relighting_gain(const PlacedObject& placed, const IrradianceHarmonics& scene) {
    const std::optional<IrradianceHarmonics>& capture = placed.object->capture_irradiance;
    const glm::mat3 world_from_object(placed.world_from_object.rotation);
    return fit_harmonics([&](const glm::vec3& normal) {
        const glm::vec3 lit = scene.at(world_from_object * normal);
        if (!capture) return glm::min(lit, glm::vec3(kMaxGain));
        const glm::vec3 least = glm::max(kLeastCaptureShare * glm::vec3(capture->factors[0]), glm::vec3(1e-6F));
        return glm::min(lit / glm::max(capture->at(normal), least), glm::vec3(kMaxGain));
    });
}

glm::dvec3 NormalProxy::normal(const glm::dvec3& origin, const glm::dvec3& direction) const {
    const glm::dvec3 from = (origin - centre) / half_axes;
    const glm::dvec3 along = glm::normalize(direction / half_axes);
    glm::dvec3 point = from - glm::dot(from, along) * along;  // of closest approach to the unit sphere's centre
    point -= std::sqrt(std::max(1 - glm::dot(point, point), 0.0)) * along;
    return glm::normalize(point / half_axes);
}

NormalProxy normal_proxy(const ViewableObject& object) {
    constexpr double kLeastHalfAxis = 0.1;
    const UprightExtent& extent = object.extent;
    const double half_height = std::max((extent.top - extent.bottom) / 2, kLeastHalfAxis);
    return {{0, (extent.top + extent.bottom) / 2, 0}, {1, half_height, 1}};
}

IrradianceHarmonics irradiance_of(const std::vector<Light>& lights, const glm::dvec3& position) {
    IrradianceHarmonics sum;
    for (const Light& light : lights) {
        if (!light.everywhere) continue;
        const bool distant = light.kind == LightKind::kDirectional;
        const glm::dvec3 way = distant ? -light.towards : light.location - position;
        const double distance = glm::length(way);
        if (!(distance > 0)) continue;
        sum.add_direction(glm::vec3(way / distance), irradiance_at(light, position));
        if (light.ambient == glm::vec3(0)) continue;
        Light ambient = light;  // has the light's range
        ambient.colour = light.ambient;
        sum.add_ambient(irradiance_at(ambient, position) / static_cast<float>(kPi));
    }
    return sum;
}

}  // namespace rs::compositor
