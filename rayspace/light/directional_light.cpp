#include "rayspace/light/light_model.hpp"

namespace rs {
namespace {

class DirectionalModel final : public LightModel {
public:
    DirectionalModel() : LightModel(LightForm::kDistant, {.kind = "directional", .power = "lux", .has_place = false}) {}

    [[nodiscard]] Status check(const Light& light) const override { return check_direction(light.towards); }
    [[nodiscard]] double strength(const Light&) const override { return kPi; }
    [[nodiscard]] glm::vec3 irradiance_at(const Light& light, const glm::dvec3&) const override {
        return static_cast<float>(kPi) * light.colour;
    }
    void describe(const LightEntry& entry, Light& light) const override {
        light.colour = colour_of(entry, kLuxOfWhite);
        light.towards = unit_vector(entry.aim);
    }
    void describe(const Light& light, LightEntry& entry) const override {
        set_colour(light.colour, kLuxOfWhite, entry);
        entry.aim = light.towards;
    }
    [[nodiscard]] LightEntry example() const override {
        LightEntry sun;
        sun.power = 1000;
        sun.aim = {-1, -2, -1};
        return sun;
    }
};

}  // namespace

Light directional_light(const glm::dvec3& towards, const glm::vec3& irradiance) {
    Light light;
    light.towards = glm::normalize(towards);
    light.colour = irradiance / static_cast<float>(kPi);
    return light;
}

const LightModel& directional_model() {
    static const DirectionalModel model;
    return model;
}

}  // namespace rs
