#pragma once
// What a kind of light is, to all who trace by it, draw it, write it down or edit it: they know its form and its words,
// and take the rest from this. A new kind is a value of LightKind, a class like those here, and its row in
// light_models.cpp.
//
// Pure and thread-safe. Lights are as check_light() needs them.

#include "rayspace/light/light.hpp"
#include "rayspace/light/light_entry.hpp"

#include <glm/glm.hpp>

#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace rs {

enum class LightForm {
    kDistant,  // along Light::towards, everywhere alike
    kPoint,    // from Light::location
    kArea,  // from a flat part of the parallelogram location +- half_u +- half_v, whose radiance is `colour`, to where
            // cross(half_u, half_v) points
};

// A number that only some kinds have.
struct LightNumber {
    const char* key;    // in lists
    const char* label;  // in panels
    double LightEntry::*value;
    double lowest, highest;
    double LightEntry::*at_most = nullptr;  // not above this one, and the same where it is left out
};

// How lists and panels name it.
struct LightWords {
    const char* kind;
    const char* power;                    // what LightEntry::power counts
    bool power_is_factor = false;         // which is 1 where it is left out
    const char* radiance = nullptr;       // what LightEntry::radiance is called; null: there is only power
    const char* radiance_unit = nullptr;  // in panels
    bool has_place = true;
    bool has_aim = true;
    bool aims_down = false;                // where no aim is given; else one must be
    bool turns = false;                    // about its aim
    bool falls_off = false;                // has a reach, and with a radiance an attenuation
    bool has_file = false;                 // a photometric one
    std::span<const char* const> sizes{};  // labels of LightEntry::size; of one, both are the same
    std::span<const LightNumber> numbers{};
};

// Of kPoint. At distance d what `colour` states is over max(attenuation.x + attenuation.y d + attenuation.z d^2,
// least_attenuation); beyond `radius`, and outside of the cone about axis(), nothing arrives.
struct LightReach {
    glm::vec3 attenuation{0, 0, 1};
    float least_attenuation = 0;
    double radius = std::numeric_limits<double>::infinity();
    float least_cos = -1;
};

struct LightDirection {
    glm::vec3 direction{0};  // away from the light, unit length
    float inverse_pdf = 0;   // steradians
};

// Polylines in the coordinates of AimedAxes: across, along, aim.
struct LightOutline {
    std::vector<std::vector<glm::dvec3>> lines;
    bool to_scale = false;  // scene units; else about 1 in size
};

class LightModel {
public:
    const LightForm form;
    const LightWords words;

    LightModel(LightForm of, const LightWords& said) : form(of), words(said) {}
    virtual ~LightModel() = default;
    LightModel(const LightModel&) = delete;
    LightModel& operator=(const LightModel&) = delete;

    // Why the light cannot be used, beyond what all kinds need.
    [[nodiscard]] virtual Status check(const Light& light) const = 0;
    // Unit length; anything where nothing is aimed.
    [[nodiscard]] virtual glm::dvec3 axis(const Light& light) const { return light.towards; }
    // Irradiance for a colour of 1, of what faces the light: kDistant everywhere, kPoint on the axis where light has
    // not fallen off, kArea as from afar, times the squared distance: its area.
    [[nodiscard]] virtual double strength(const Light& light) const = 0;
    // What the whole light sends, W; of points as if they fell off by the square, and were as strong as they are at
    // `distance`, or at their radius where that is less. kDistant: 0.
    [[nodiscard]] virtual glm::dvec3 flux(const Light& light, double distance) const;
    // rs::punctual_of().
    [[nodiscard]] virtual Light punctual(const Light& light) const { return light; }

    // kDistant and kPoint: rs::irradiance_at().
    [[nodiscard]] virtual glm::vec3 irradiance_at(const Light& light, const glm::dvec3& position) const;

    // kPoint only.
    [[nodiscard]] virtual bool is_even() const { return false; }       // the same in all directions
    [[nodiscard]] virtual LightReach reach(const Light& light) const;  // milliseconds, where a web is searched
    // Drawn by about the intensity; u in [0, 1)^2. Nothing where there is no light.
    [[nodiscard]] virtual std::optional<LightDirection> sample(const Light& light, const glm::vec2& u) const;

    // kArea only: of the coordinates -1..1 along its halves, what belongs to the light, and a point of that, drawn
    // evenly.
    [[nodiscard]] virtual bool covers(const glm::vec2& at) const;
    [[nodiscard]] virtual glm::vec2 point(const glm::vec2& u) const;

    // light_of() and entry_of(): what is not the same for all kinds.
    virtual void describe(const LightEntry& entry, Light& light) const = 0;
    virtual void describe(const Light& light, LightEntry& entry) const = 0;
    // One to begin with.
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

// What models share. An error where a direction has not unit length.
Status check_direction(const glm::dvec3& towards);
inline constexpr double kLuxOfWhite = kPi * kLumensPerWatt;  // lux on white matter that make it show radiance 1
// The colour of an entry's light, and an entry's power and colour for a light's; `unit`: the power of a colour of 1.
glm::vec3 colour_of(const LightEntry& entry, double unit);
void set_colour(const glm::vec3& colour, double unit, LightEntry& entry);
// Of an entry with this aim, the turn that brings AimedAxes::across here.
double turn_of(const glm::dvec3& aim, const glm::dvec3& across);

}  // namespace rs
