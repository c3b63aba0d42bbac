#pragma once
// A light as a list of lights states it (compositor/scene/light/lights_file.hpp): in the units of lamps, with the names
// of files. This is what is edited and saved. A Light is computed from it, from the same entry always the same. Which
// of the numbers a kind has, and what they are called: light_model.hpp.

#include "rayspace/light/light.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace rs {

// Limits of numbers in lists.
inline constexpr double kMostDistant = 1e6;
inline constexpr double kShortest = 1e-6;
inline constexpr double kStrongest = 1e12;
inline constexpr double kLeastCutOff_deg = 0.1;

struct LightEntry {
    LightKind kind = LightKind::kPoint;
    std::string name{};    // may be empty
    glm::dvec3 colour{1};  // a factor in linear light, 0..kStrongest
    // Where there is no `radiance`. Directional: lux on a surface that faces it; points and spots: candela; areas:
    // lumens; luminaires: a factor on what the file states, a dimmer.
    double power = 1;
    // Areas: W / (m^2 sr). Points and spots: VRML97's intensity times colour, what white matter shows that faces the
    // light where 1 / attenuation is 1; it is nowhere more.
    std::optional<glm::dvec3> radiance{};
    glm::dvec3 location{0};    // all but directional ones
    glm::dvec3 aim{0, -1, 0};  // all but points; any length but 0
    double turn_deg = 0;       // areas and luminaires: about the aim
    glm::dvec2 size{1};        // areas: across and along; of a disc the diameter, twice
    double beam_deg = 30;      // spots: full angles, beam_deg <= cut_off_deg
    double cut_off_deg = 40;
    glm::dvec3 attenuation{1, 0, 0};                         // points and spots with a `radiance`
    double reach = std::numeric_limits<double>::infinity();  // points and spots: no light beyond
    glm::dvec3 ambient{0};                                   // of all kinds, as Light::ambient
    std::optional<std::uint32_t> scope{};  // shines only on what this light of the scene's file shone on
    // Luminaires.
    std::filesystem::path file{};
    std::shared_ptr<const Luminaire> luminaire{};

    bool operator==(const LightEntry&) const = default;
};

// What the entry states; its numbers within the limits above. All here are pure and thread-safe.
Light light_of(const LightEntry& entry);

// An entry for a light that comes from elsewhere. Of it light_of() gives the same colours, places and directions, bit
// for bit, and the same angles within rounding, for directional lights, and for points and spots whose beam is not
// wider than their cut-off, whose radius is within the limits, and whose light either falls off by the square of the
// distance or is nowhere above `colour`.
LightEntry entry_of(const Light& light);

// Axes of what is turned by `turn_rad` about its aim: along x across = -aim, so that an area of these halves shines to
// where it is aimed. At 0 across lies where +X is best seen, or +Z where the aim is along X. `aim` has unit length.
struct AimedAxes {
    glm::dvec3 across, along;
};
AimedAxes axes_of(const glm::dvec3& aim, double turn_rad);

// v, with unit length; v itself where it has that.
glm::dvec3 unit_of(const glm::dvec3& v);

}  // namespace rs
