// Luminaire light: a point light with a photometric web.
#include "rayspace/light/light_model.hpp"

#include <algorithm>
#include <cmath>

namespace rs {
namespace {

constexpr LightWords kLuminaireWords{.kind = "luminaire",
                                     .power = "dimmer",
                                     .power_is_factor = true,
                                     .aims_down = true,
                                     .turns = true,
                                     .has_file = true};

// Cosine of the cone that contains all light, found by scanning the web in steps of one degree.
float min_cos_of(const PhotometricWeb& web) {
    constexpr int kTurns = 48;
    for (int polar = 179; polar > 0; --polar) {
        const double p = radians(polar);
        for (int turn = 0; turn < kTurns; ++turn) {
            const double t = 2 * kPi * turn / kTurns;
            if (web.candela({std::sin(p) * std::cos(t), -std::cos(p), std::sin(p) * std::sin(t)}) > 0) {
                return polar == 179 ? -1.0F : static_cast<float>(std::cos(radians(polar + 1.5)));
            }
        }
    }
    return -1.0F;
}

class LuminaireModel final : public LightModel {
public:
    LuminaireModel() : LightModel(LightForm::kPoint, kLuminaireWords) {}

    [[nodiscard]] Status check(const Light& light) const override {
        if (light.luminaire == nullptr) return Error{"it has no photometric file"};
        return {};
    }
    [[nodiscard]] glm::dvec3 axis(const Light& light) const override {
        return light.world_from_luminaire * glm::dvec3(0, -1, 0);
    }
    [[nodiscard]] double strength(const Light& light) const override {
        return light.luminaire->web.peak_candela() / kLumensPerWatt;
    }
    [[nodiscard]] glm::dvec3 flux(const Light& light, double) const override {
        return glm::dvec3(light.colour) * (light.luminaire->web.lumens() / kLumensPerWatt);
    }
    [[nodiscard]] glm::vec3 irradiance_at(const Light& light, const glm::dvec3& position) const override {
        const glm::dvec3 way = position - light.location;
        const double distance2 = glm::dot(way, way);
        if (!(distance2 > 0)) return glm::vec3(0);
        const double candela = light.luminaire->web.candela(glm::transpose(light.world_from_luminaire) * way);
        return light.colour * static_cast<float>(candela / (kLumensPerWatt * distance2));
    }
    [[nodiscard]] LightReach reach(const Light& light) const override {
        LightReach reach;
        reach.min_cos = min_cos_of(light.luminaire->web);
        return reach;
    }
    [[nodiscard]] std::optional<LightDirection> sample(const Light& light, const glm::vec2& u) const override {
        const glm::dvec3 direction = light.luminaire->web.sample(glm::dvec2(u));
        const double pdf = light.luminaire->web.pdf(direction);
        if (!(pdf > 0)) return std::nullopt;
        return LightDirection{glm::vec3(light.world_from_luminaire * direction), static_cast<float>(1 / pdf)};
    }
    [[nodiscard]] Light punctual(const Light& light) const override {
        Light spot = point_light(light.location, light.colour * static_cast<float>(strength(light)));
        spot.kind = LightKind::kSpot;
        spot.towards = axis(light);
        // A spot has one side: light to the opposite one is lost.
        const PhotometricWeb& web = light.luminaire->web;
        const BeamPart part = is_direct_indirect(web) ? BeamPart::kTowardsAim : BeamPart::kWhole;
        const BeamSpread across = beam_spread(web, 0, part);
        const BeamSpread along = beam_spread(web, 90, part);
        // Linear falloff: half the intensity half-way from the axis to the cut-off.
        const double half_beam = std::clamp(0.25 * (across.beam_rad + along.beam_rad), 0.01, kPi / 4);
        spot.beam_width_rad = 0;
        spot.cut_off_rad = 2 * half_beam;
        return spot;
    }

    void describe(const LightEntry& entry, Light& light) const override {
        light.colour = colour_of(entry, 1);
        light.luminaire = entry.luminaire;
        const glm::dvec3 aim = unit_vector(entry.aim);
        const AimedAxes axes = aimed_axes(aim, radians(entry.turn_deg));
        // The luminaire's X (plane C0), -Z (plane C90) and nadir.
        light.world_from_luminaire = glm::dmat3(axes.across, -aim, -axes.along);
    }
    void describe(const Light& light, LightEntry& entry) const override {
        set_colour(light.colour, 1, entry);
        entry.luminaire = light.luminaire;
        entry.aim = axis(light);
        entry.turn_deg = turn_of(entry.aim, light.world_from_luminaire[0]);
    }
    [[nodiscard]] LightEntry example() const override { return {}; }

    // Polar curves of the web in planes C0 and C90.
    [[nodiscard]] LightOutline outline(const LightEntry& entry) const override {
        constexpr int kSteps = 48;
        LightOutline shape;
        if (!entry.luminaire) return shape;
        const PhotometricWeb& web = entry.luminaire->web;
        for (const int plane : {0, 90}) {
            std::vector<glm::dvec3>& line = shape.lines.emplace_back();
            for (int i = 0; i <= kSteps; ++i) {
                const double angle = 2 * kPi * i / kSteps - kPi;
                const double out = candela_in_plane(web, plane, angle) / web.peak_candela();
                const double aside = out * std::sin(angle);
                line.emplace_back(plane == 0 ? aside : 0, plane == 0 ? 0 : aside, out * std::cos(angle));
            }
        }
        return shape;
    }
};

}  // namespace

const LightModel& luminaire_model() {
    static const LuminaireModel model;
    return model;
}

}  // namespace rs
