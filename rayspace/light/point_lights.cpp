// Point and spot lights.
#include "rayspace/light/directions.hpp"
#include "rayspace/light/light_model.hpp"

#include <algorithm>
#include <cmath>

namespace rs {
namespace {

// Full angle in degrees such that radians(angle) / 2 == half_rad exactly, if it exists; otherwise the nearest.
double full_degrees(double half_rad) {
    const double nearest = degrees(2 * half_rad);
    double down = nearest;
    double up = nearest;
    for (int i = 0; i < 4; ++i) {
        if (radians(down) / 2 == half_rad) return down;
        if (radians(up) / 2 == half_rad) return up;
        down = std::nextafter(down, 0.0);
        up = std::nextafter(up, 360.0);
    }
    return nearest;
}

double half_angle(double full_deg) {
    return radians(full_deg) / 2;
}

constexpr LightWords kPointWords{
    .kind = "point", .power = "candela", .radiance = "intensity", .has_aim = false, .falls_off = true};

constexpr LightNumber kCone[] = {{"beam_deg", "beam, degrees", &LightEntry::beam_deg, 0, 180, &LightEntry::cut_off_deg},
                                 {"cut_off_deg", "cut-off, degrees", &LightEntry::cut_off_deg, kMinCutOff_deg, 180}};
constexpr LightWords kSpotWords{
    .kind = "spot", .power = "candela", .radiance = "intensity", .falls_off = true, .numbers = kCone};

class PointModel : public LightModel {
public:
    explicit PointModel(const LightWords& kind_words = kPointWords) : LightModel(LightForm::kPoint, kind_words) {}

    [[nodiscard]] Status check(const Light&) const override { return {}; }
    [[nodiscard]] double strength(const Light&) const override { return kPi; }

    [[nodiscard]] glm::dvec3 flux(const Light& light, double distance) const override {
        const double d = std::min(distance, light.radius);
        if (!(d > 0)) return glm::dvec3(0);
        return glm::dvec3(light.colour) * (kPi * solid_angle(light) * d * d * falloff(light, d, d * d));
    }

    [[nodiscard]] glm::vec3 irradiance_at(const Light& light, const glm::dvec3& position) const override {
        const glm::dvec3 way = position - light.location;
        const double distance2 = glm::dot(way, way);
        const double d = std::sqrt(distance2);
        if (!(d > 0) || d > light.radius) return glm::vec3(0);
        const double strength = falloff(light, d, distance2) * share(light, way, d);
        return kPiF * light.colour * static_cast<float>(strength);
    }

    [[nodiscard]] bool is_isotropic() const override { return true; }
    [[nodiscard]] LightReach reach(const Light& light) const override {
        return {light.attenuation, light.least_attenuation, light.radius, -1.0F};
    }
    [[nodiscard]] std::optional<LightDirection> sample(const Light&, const glm::vec2& u) const override {
        return LightDirection{Frame(glm::vec3(0, 0, 1)).to_world(sample_cone(u, -1.0F)), 4.0F * kPiF};
    }

    void describe(const LightEntry& entry, Light& light) const override {
        light.colour = colour_of(entry, kLuxOfWhite);
        light.attenuation = entry.radiance ? glm::vec3(entry.attenuation) : glm::vec3(0, 0, 1);
        light.least_attenuation = entry.radiance ? 1 : 0;
        light.radius = entry.reach;
    }
    void describe(const Light& light, LightEntry& entry) const override {
        if (is_inverse_square(light)) {
            set_colour(light.colour, kLuxOfWhite, entry);
        } else {
            entry.radiance = glm::dvec3(light.colour);
            entry.attenuation = glm::dvec3(light.attenuation);
        }
        if (light.radius <= kMaxLightDistance) entry.reach = std::max(light.radius, kShortest);
    }
    [[nodiscard]] LightEntry example() const override {
        LightEntry lamp;
        lamp.power = 100;
        return lamp;
    }

private:
    static double falloff(const Light& light, double d, double d2) {
        const double attenuation = glm::dot(glm::dvec3(light.attenuation), glm::dvec3(1, d, d2));
        return 1 / std::max(attenuation, static_cast<double>(light.least_attenuation));
    }

    // Intensity along `way`, of length d, relative to the axis; and its integral over all directions.
    [[nodiscard]] virtual double share(const Light&, const glm::dvec3&, double) const { return 1; }
    [[nodiscard]] virtual double solid_angle(const Light&) const { return 4 * kPi; }
};

class SpotModel final : public PointModel {
public:
    SpotModel() : PointModel(kSpotWords) {}

    [[nodiscard]] Status check(const Light& light) const override { return check_direction(light.towards); }
    [[nodiscard]] bool is_isotropic() const override { return false; }
    [[nodiscard]] LightReach reach(const Light& light) const override {
        LightReach reach = PointModel::reach(light);
        reach.min_cos = static_cast<float>(std::cos(light.cut_off_rad)) - 1e-4F;
        return reach;
    }
    [[nodiscard]] std::optional<LightDirection> sample(const Light& light, const glm::vec2& u) const override {
        const auto min_cos = static_cast<float>(std::cos(std::min(light.cut_off_rad, kPi)));
        return LightDirection{Frame(glm::vec3(light.towards)).to_world(sample_cone(u, min_cos)),
                              2.0F * kPiF * (1.0F - min_cos)};
    }

    void describe(const LightEntry& entry, Light& light) const override {
        PointModel::describe(entry, light);
        light.towards = unit_vector(entry.aim);
        light.cut_off_rad = half_angle(entry.cut_off_deg);
        light.beam_width_rad = half_angle(entry.beam_deg);
    }
    void describe(const Light& light, LightEntry& entry) const override {
        PointModel::describe(light, entry);
        entry.aim = light.towards;
        entry.cut_off_deg = std::max(full_degrees(light.cut_off_rad), kMinCutOff_deg);
        entry.beam_deg = std::min(full_degrees(light.beam_width_rad), entry.cut_off_deg);
    }
    [[nodiscard]] LightEntry example() const override {
        LightEntry lamp;
        lamp.power = 500;
        return lamp;
    }

    // Circles of beam and cut-off, and lines along the cone.
    [[nodiscard]] LightOutline outline(const LightEntry& entry) const override {
        constexpr int kCorners = 32;
        constexpr int kSides = 4;
        LightOutline cone;
        const auto add_circle = [&](double angle_rad) {
            std::vector<glm::dvec3>& circle = cone.lines.emplace_back();
            for (int i = 0; i <= kCorners; ++i) {
                const double turn = 2 * kPi * i / kCorners;
                circle.emplace_back(std::sin(angle_rad) * std::cos(turn), std::sin(angle_rad) * std::sin(turn),
                                    std::cos(angle_rad));
            }
            return circle;
        };
        const std::vector<glm::dvec3> rim = add_circle(half_angle(entry.cut_off_deg));
        for (std::size_t i = 0; i < kCorners; i += kCorners / kSides) cone.lines.push_back({glm::dvec3(0), rim[i]});
        if (entry.beam_deg > 0 && entry.beam_deg < entry.cut_off_deg) add_circle(half_angle(entry.beam_deg));
        return cone;
    }

private:
    // 1 within the beam, then linear to 0 at the cut-off.
    [[nodiscard]] double share(const Light& light, const glm::dvec3& way, double d) const override {
        const double angle = std::acos(std::clamp(glm::dot(way, light.towards) / d, -1.0, 1.0));
        if (angle > light.cut_off_rad) return 0;
        if (angle <= light.beam_width_rad) return 1;
        return (light.cut_off_rad - angle) / (light.cut_off_rad - light.beam_width_rad);
    }
    [[nodiscard]] double solid_angle(const Light& light) const override {
        const double cut_off = light.cut_off_rad;
        const double beam = std::min(light.beam_width_rad, cut_off);
        const double mean_cos =
            beam < cut_off ? (std::sin(cut_off) - std::sin(beam)) / (cut_off - beam) : std::cos(cut_off);
        return 2 * kPi * (1 - mean_cos);
    }
};

}  // namespace

Light point_light(const glm::dvec3& location, const glm::vec3& intensity) {
    Light light;
    light.kind = LightKind::kPoint;
    light.location = location;
    light.colour = intensity / kPiF;
    light.attenuation = {0, 0, 1};
    light.least_attenuation = 0;
    light.radius = std::numeric_limits<double>::infinity();
    return light;
}

bool is_inverse_square(const Light& light) {
    return light.attenuation == glm::vec3(0, 0, 1) && light.least_attenuation == 0;
}

const LightModel& point_model() {
    static const PointModel model;
    return model;
}

const LightModel& spot_model() {
    static const SpotModel model;
    return model;
}

}  // namespace rs
