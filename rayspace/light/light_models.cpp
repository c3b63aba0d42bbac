#include "rayspace/light/light_model.hpp"

#include <array>
#include <tuple>

namespace rs {

// Defined in the file of each kind.
const LightModel& point_model();
const LightModel& spot_model();
const LightModel& luminaire_model();
const LightModel& rectangle_model();
const LightModel& disc_model();
const LightModel& directional_model();

const LightModel& model_of(LightKind kind) {
    // In the order of LightKind.
    static const std::array models = {&point_model(),     &spot_model(), &luminaire_model(),
                                      &rectangle_model(), &disc_model(), &directional_model()};
    static_assert(std::tuple_size_v<decltype(models)> == kLightKinds);
    return *models[static_cast<std::size_t>(kind)];
}

glm::dvec3 LightModel::flux(const Light&, double) const {
    return glm::dvec3(0);
}

glm::vec3 LightModel::irradiance_at(const Light&, const glm::dvec3&) const {
    return glm::vec3(0);
}

LightReach LightModel::reach(const Light&) const {
    return {};
}

std::optional<LightDirection> LightModel::sample(const Light&, const glm::vec2&) const {
    return std::nullopt;
}

bool LightModel::covers(const glm::vec2&) const {
    return false;
}

glm::vec2 LightModel::point(const glm::vec2&) const {
    return glm::vec2(0);
}

}  // namespace rs
