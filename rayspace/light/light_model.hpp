#pragma once
// Interface of a kind of light for tracing, drawing, serialisation and editing, which depend on its form and its words
// only. A new kind consists of a value of LightKind, a subclass of LightModel, and its row in light_models.cpp.
//
// All functions are pure and thread-safe. Lights must satisfy check_light().

#include "rayspace/light/light.hpp"
#include "rayspace/light/light_entry.hpp"

#include <glm/glm.hpp>

#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace rs {

enum class LightForm {
    kDistant,  // uniform, along Light::towards
    kPoint,    // from Light::location
    kArea,     // a flat part of the parallelogram location +- half_u +- half_v with radiance `colour`, one-sided
               // towards cross(half_u, half_v)
};

// A number specific to some kinds.
struct LightNumber {
    const char* key;    // in light lists
    const char* label;  // in user interfaces
    double LightEntry::*value;
    double lowest, highest;
    double LightEntry::*at_most = nullptr;  // upper bound and default
};

// Names and fields of a kind in light lists and user interfaces.
struct LightWords {
    const char* kind;
    const char* power;                    // name and unit of LightEntry::power
    bool power_is_factor = false;         // optional with default 1
    const char* radiance = nullptr;       // name of LightEntry::radiance; null: not supported
    const char* radiance_unit = nullptr;  // in user interfaces
    bool has_place = true;
    bool has_aim = true;
    bool aims_down = false;                // default aim; otherwise the aim is mandatory
    bool turns = false;                    // can be rotated about its aim
    bool falls_off = false;                // has a reach and, with a radiance, an attenuation
    bool has_file = false;                 // photometric file
    std::span<const char* const> sizes{};  // labels of LightEntry::size; a single label: both components are equal
    std::span<const LightNumber> numbers{};
};

// Range of a kPoint light. At distance d the intensity is divided by max(attenuation.x + attenuation.y d +
// attenuation.z d^2, least_attenuation); it is 0 beyond `radius` and outside the cone about axis().
struct LightReach {
    glm::vec3 attenuation{0, 0, 1};
    float least_attenuation = 0;
    double radius = std::numeric_limits<double>::infinity();
    float min_cos = -1;
};

struct LightDirection {
    glm::vec3 direction{0};  // away from the light, unit length
    float inverse_pdf = 0;   // steradians
};

// Icon as polylines in the coordinates of AimedAxes: across, along, aim.
struct LightOutline {
    std::vector<std::vector<glm::dvec3>> lines;
    bool to_scale = false;  // in scene units; otherwise the size is about 1
};

class LightModel {
public:
    const LightForm form;
    const LightWords words;

    LightModel(LightForm light_form, const LightWords& light_words) : form(light_form), words(light_words) {}
    virtual ~LightModel() = default;
    LightModel(const LightModel&) = delete;
    LightModel& operator=(const LightModel&) = delete;

    // Validation specific to the kind, see check_light().
    [[nodiscard]] virtual Status check(const Light& light) const = 0;
    // Unit length; unspecified for kinds without an aim.
    [[nodiscard]] virtual glm::dvec3 axis(const Light& light) const { return light.towards; }
    // Irradiance on a surface that faces the light, for colour 1. kPoint: on the axis, without attenuation; kArea: at a
    // large distance, times the squared distance, i.e. its area.
    [[nodiscard]] virtual double strength(const Light& light) const = 0;
    // Radiant flux, W. kPoint: of an inverse-square light with the same irradiance at `distance`, or at the radius if
    // that is smaller. kDistant: 0.
    [[nodiscard]] virtual glm::dvec3 flux(const Light& light, double distance) const;
    // See rs::to_punctual_light().
    [[nodiscard]] virtual Light punctual(const Light& light) const { return light; }

    // kDistant and kPoint: see rs::irradiance_at().
    [[nodiscard]] virtual glm::vec3 irradiance_at(const Light& light, const glm::dvec3& position) const;

    // kPoint only.
    [[nodiscard]] virtual bool is_isotropic() const { return false; }  // the same intensity in all directions
    [[nodiscard]] virtual LightReach reach(const Light& light) const;  // takes milliseconds for a photometric web
    // Samples a direction approximately in proportion to intensity; u in [0, 1)^2. Empty if the light is dark.
    [[nodiscard]] virtual std::optional<LightDirection> sample(const Light& light, const glm::vec2& u) const;

    // kArea only, in coordinates -1..1 along half_u and half_v: membership test, and a uniformly sampled point.
    [[nodiscard]] virtual bool covers(const glm::vec2& at) const;
    [[nodiscard]] virtual glm::vec2 point(const glm::vec2& u) const;

    // Parts of light_of() and entry_from_light() specific to the kind.
    virtual void describe(const LightEntry& entry, Light& light) const = 0;
    virtual void describe(const Light& light, LightEntry& entry) const = 0;
    // Default for a new light.
    [[nodiscard]] virtual LightEntry example() const = 0;
    [[nodiscard]] virtual LightOutline outline(const LightEntry&) const { return {}; }
};

const LightModel& model_of(LightKind kind);
inline const LightModel& model_of(const Light& light) {
    return model_of(light.kind);
}
inline const LightModel& model_of(const LightEntry& entry) {
    return model_of(entry.kind);
}

// Shared by the models. Returns an error if a direction does not have unit length.
Status check_direction(const glm::dvec3& towards);
inline constexpr double kLuxOfWhite = kPi * kLumensPerWatt;  // illuminance of a white diffuse surface with radiance 1
// Colour of an entry's light, and the inverse; `unit`: power of a light with colour 1.
glm::vec3 colour_of(const LightEntry& entry, double unit);
void set_colour(const glm::vec3& colour, double unit, LightEntry& entry);
// Rotation about the aim, in degrees, that yields AimedAxes::across == `across`.
double turn_of(const glm::dvec3& aim, const glm::dvec3& across);

}  // namespace rs
