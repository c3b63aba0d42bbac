#include "rayspace/light/light_model.hpp"

#include <algorithm>
#include <cmath>

namespace rs {

// A single rounding to float, so that entry_from_light() can invert it exactly.
glm::vec3 colour_of(const LightEntry& entry, double unit) {
    return glm::vec3(entry.radiance ? *entry.radiance * entry.colour : entry.power / unit * entry.colour);
}

void set_colour(const glm::vec3& colour, double unit, LightEntry& entry) {
    const glm::dvec3 exact(colour);
    const double most = std::max({exact.x, exact.y, exact.z});
    entry.power = most * unit;
    entry.colour = most > 0 ? exact / most : glm::dvec3(1);
}

double turn_of(const glm::dvec3& aim, const glm::dvec3& across) {
    const AimedAxes at_rest = aimed_axes(aim, 0);
    return degrees(std::atan2(glm::dot(across, at_rest.along), glm::dot(across, at_rest.across)));
}

glm::dvec3 unit_vector(const glm::dvec3& v) {
    return std::abs(glm::dot(v, v) - 1) < 1e-15 ? v : glm::normalize(v);
}

AimedAxes aimed_axes(const glm::dvec3& aim, double turn_rad) {
    const glm::dvec3 towards = std::abs(aim.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 across = glm::normalize(towards - glm::dot(towards, aim) * aim);
    const glm::dvec3 quarter = glm::cross(-aim, across);  // counter-clockwise as seen from behind the light
    return {std::cos(turn_rad) * across + std::sin(turn_rad) * quarter,
            std::cos(turn_rad) * quarter - std::sin(turn_rad) * across};
}

Light light_of(const LightEntry& entry) {
    Light light;
    light.kind = entry.kind;
    light.name = entry.name;
    light.ambient = glm::vec3(entry.ambient);
    light.everywhere = !entry.scope;
    light.location = entry.location;
    model_of(entry).describe(entry, light);
    return light;
}

LightEntry entry_from_light(const Light& light) {
    const LightModel& model = model_of(light);
    LightEntry entry;
    entry.kind = light.kind;
    entry.name = light.name;
    entry.ambient = glm::dvec3(light.ambient);
    if (model.words.has_place) entry.location = light.location;
    model.describe(light, entry);
    return entry;
}

}  // namespace rs
