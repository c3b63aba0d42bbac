#include "rayspace/light/directions.hpp"
#include "rayspace/light/light_model.hpp"

#include <algorithm>
#include <cmath>

namespace rs {
namespace {

constexpr const char* kTwoSides[] = {"across", "along"};
constexpr const char* kDiameter[] = {"diameter"};

class AreaModel : public LightModel {
public:
    // `share`: area of a light whose half sides are perpendicular with length 1.
    AreaModel(const char* kind, std::span<const char* const> sizes, double share)
        : LightModel(LightForm::kArea, {.kind = kind,
                                        .power = "lumens",
                                        .radiance = "radiance",
                                        .radiance_unit = "W/(m2 sr)",
                                        .turns = true,
                                        .sizes = sizes}),
          share_(share) {}

    [[nodiscard]] Status check(const Light& light) const override {
        const double area = strength(light);
        if (!(area > 0 && std::isfinite(area))) return Error{"its edges must be finite and span an area"};
        return {};
    }
    [[nodiscard]] glm::dvec3 axis(const Light& light) const override {
        return glm::normalize(glm::cross(light.half_u, light.half_v));
    }
    [[nodiscard]] double strength(const Light& light) const override {
        return glm::length(glm::cross(light.half_u, light.half_v)) * share_;
    }
    [[nodiscard]] glm::dvec3 flux(const Light& light, double) const override {
        return glm::dvec3(light.colour) * (kPi * strength(light));
    }
    [[nodiscard]] Light punctual(const Light& light) const override {
        const auto white = static_cast<float>(strength(light) / kPi);
        Light spot = point_light(light.location, light.colour);
        spot.kind = LightKind::kSpot;
        spot.towards = axis(light);
        // Approximates the cosine by a linear falloff from the axis to the area's plane.
        spot.beam_width_rad = 0;
        spot.cut_off_rad = kPi / 2;
        spot.colour = light.colour * white;
        spot.least_attenuation = white;
        return spot;
    }

    void describe(const LightEntry& entry, Light& light) const override {
        const AimedAxes axes = aimed_axes(unit_vector(entry.aim), radians(entry.turn_deg));
        light.half_u = 0.5 * entry.size.y * axes.along;
        light.half_v = 0.5 * entry.size.x * axes.across;
        light.colour = colour_of(entry, kLuxOfWhite * strength(light));
    }
    void describe(const Light& light, LightEntry& entry) const override {
        set_colour(light.colour, kLuxOfWhite * strength(light), entry);
        entry.aim = axis(light);
        entry.size = {2 * glm::length(light.half_v), 2 * glm::length(light.half_u)};
        if (words.sizes.size() == 1) entry.size = glm::dvec2(entry.size.x);
        entry.turn_deg = turn_of(entry.aim, glm::normalize(light.half_v));
    }

    [[nodiscard]] LightOutline outline(const LightEntry& entry) const override {
        LightOutline edge;
        edge.to_scale = true;
        std::vector<glm::dvec3>& line = edge.lines.emplace_back();
        for (const glm::dvec2& at : rim()) line.emplace_back(0.5 * entry.size * at, 0);
        line.push_back(line.front());
        return edge;
    }

private:
    // Closed contour in coordinates -1..1.
    [[nodiscard]] virtual std::vector<glm::dvec2> rim() const = 0;

    double share_;
};

class RectangleModel final : public AreaModel {
public:
    RectangleModel() : AreaModel("rectangle", kTwoSides, 4) {}

    [[nodiscard]] bool covers(const glm::vec2& at) const override {
        return std::max(std::abs(at.x), std::abs(at.y)) <= 1.0F;
    }
    [[nodiscard]] glm::vec2 point(const glm::vec2& u) const override { return 2.0F * u - 1.0F; }
    [[nodiscard]] LightEntry example() const override {
        LightEntry panel;
        panel.power = 2000;
        panel.size = {0.6, 0.3};
        return panel;
    }

private:
    [[nodiscard]] std::vector<glm::dvec2> rim() const override { return {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}; }
};

class DiscModel final : public AreaModel {
public:
    DiscModel() : AreaModel("disc", kDiameter, kPi) {}

    [[nodiscard]] bool covers(const glm::vec2& at) const override { return glm::dot(at, at) <= 1.0F; }
    [[nodiscard]] glm::vec2 point(const glm::vec2& u) const override { return sample_disc(u); }
    [[nodiscard]] LightEntry example() const override {
        LightEntry panel;
        panel.power = 1000;
        panel.size = glm::dvec2(0.3);
        return panel;
    }

private:
    [[nodiscard]] std::vector<glm::dvec2> rim() const override {
        constexpr int kCorners = 32;
        std::vector<glm::dvec2> corners;
        for (int i = 0; i < kCorners; ++i) {
            corners.emplace_back(std::cos(2 * kPi * i / kCorners), std::sin(2 * kPi * i / kCorners));
        }
        return corners;
    }
};

}  // namespace

Light rectangle_light(const glm::dvec3& corner, const glm::dvec3& side_u, const glm::dvec3& side_v,
                      const glm::vec3& radiance) {
    Light light;
    light.kind = LightKind::kRectangle;
    light.location = corner + 0.5 * (side_u + side_v);
    light.half_u = 0.5 * side_u;
    light.half_v = 0.5 * side_v;
    light.colour = radiance;
    return light;
}

const LightModel& rectangle_model() {
    static const RectangleModel model;
    return model;
}

const LightModel& disc_model() {
    static const DiscModel model;
    return model;
}

}  // namespace rs
