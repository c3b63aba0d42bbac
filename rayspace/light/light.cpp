#include "rayspace/light/light_model.hpp"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace rs {
namespace {

template <class Vector>
bool finite(const Vector& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

double area_of(const Light& light) {
    const LightModel& model = model_of(light);
    return model.form == LightForm::kArea ? model.strength(light) : 0;
}

glm::vec3 irradiance_at(const Light& light, const glm::dvec3& position) {
    return model_of(light).irradiance_at(light, position);
}

Light to_punctual_light(const Light& light) {
    Light punctual = model_of(light).punctual(light);
    punctual.everywhere = light.everywhere;
    punctual.name = light.name;
    return punctual;
}

Light rotate_about_y(const Light& light, double angle_rad) {
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), angle_rad, glm::dvec3(0, 1, 0)));
    Light turned = light;
    turned.towards = turn * light.towards;
    turned.location = turn * light.location;
    turned.half_u = turn * light.half_u;
    turned.half_v = turn * light.half_v;
    turned.world_from_luminaire = turn * light.world_from_luminaire;
    return turned;
}

Status check_direction(const glm::dvec3& towards) {
    if (finite(towards) && std::abs(glm::length(towards) - 1) < 1e-6) return {};
    return Error{"its direction must not be zero"};
}

Status check_light(const Light& light) {
    if (!finite(light.colour) || std::min({light.colour.x, light.colour.y, light.colour.z}) < 0) {
        return Error{"its colour must be finite and not negative"};
    }
    const LightModel& model = model_of(light);
    if (model.form != LightForm::kDistant && !finite(light.location)) return Error{"its location must be finite"};
    return model.check(light);
}

}  // namespace rs
