#pragma once
// Light as described in a light list (compositor/scene/light/lights_file.hpp): in photometric units, with file names.
// Entries are edited and saved; a Light is computed from an entry deterministically. The fields and names used by each
// kind: light_model.hpp.

#include "rayspace/light/light.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace rs {

// Limits of numbers in light lists.
inline constexpr double kMaxLightDistance = 1e6;
inline constexpr double kShortest = 1e-6;
inline constexpr double kMaxLightStrength = 1e12;
inline constexpr double kMinCutOff_deg = 0.1;

struct LightEntry {
    LightKind kind = LightKind::kPoint;
    std::string name{};    // may be empty
    glm::dvec3 colour{1};  // factor in linear light, 0..kMaxLightStrength
    // Used without `radiance`. Directional: lux on a surface that faces it; point and spot: candela; area: lumens;
    // luminaire: factor on the file's intensity (dimmer).
    double power = 1;
    // Area: W / (m^2 sr). Point and spot: VRML97's intensity times colour, the radiance of a white diffuse surface that
    // faces the light at attenuation 1, which is the maximum.
    std::optional<glm::dvec3> radiance{};
    glm::dvec3 location{0};    // all but directional
    glm::dvec3 aim{0, -1, 0};  // all but point; any length > 0
    double turn_deg = 0;       // area and luminaire: rotation about the aim
    glm::dvec2 size{1};        // area: across and along; disc: both the diameter
    double beam_deg = 30;      // spot: full angles, beam_deg <= cut_off_deg
    double cut_off_deg = 40;
    glm::dvec3 attenuation{1, 0, 0};                         // point and spot with `radiance`
    double reach = std::numeric_limits<double>::infinity();  // point and spot: no light beyond
    glm::dvec3 ambient{0};                                   // see Light::ambient
    std::optional<std::uint32_t> scope{};  // restricts the light to the geometry lit by this light of the scene file
    // Luminaires.
    std::filesystem::path file{};
    std::shared_ptr<const Luminaire> luminaire{};

    bool operator==(const LightEntry&) const = default;
};

// All functions below are pure and thread-safe.

/// Converts an entry, whose numbers must be within the limits above.
Light light_of(const LightEntry& entry);

/// Converts a light to an entry. light_of() restores colours, locations and directions bit-exactly, and angles within
/// rounding, for directional lights, and for point and spot lights with a beam not wider than the cut-off, a radius
/// within the limits, and either inverse-square falloff or a maximum of `colour`.
LightEntry entry_from_light(const Light& light);

// Axes perpendicular to the aim, rotated about it by `turn_rad`: along x across = -aim, so that an area light with
// these half sides emits towards its aim. Without rotation, across is the projection of +X, or of +Z for an aim close
// to X. `aim` has unit length.
struct AimedAxes {
    glm::dvec3 across, along;
};
AimedAxes aimed_axes(const glm::dvec3& aim, double turn_rad);

/// Normalises v; returns unit vectors unchanged.
glm::dvec3 unit_vector(const glm::dvec3& v);

}  // namespace rs
