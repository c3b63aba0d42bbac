#pragma once
// Light source of any origin (VRML97, glTF, recipe, light list) for all renderers (raster, tracer).
//
// Colours are linear light and may exceed 1. Meaning of `colour`:
//   directional, point, spot   irradiance / pi without attenuation: the radiance of a white diffuse surface that faces
//                              the light (VRML97's lighting formula)
//   rectangle, disc            the radiance of the area itself
//   luminaire                  a factor on its photometric web, whose radiant intensity is candela / kLumensPerWatt

#include "rayspace/base/conventions.hpp"
#include "rayspace/light/luminaire.hpp"

#include <glm/glm.hpp>

#include <limits>
#include <memory>
#include <string>

namespace rs {

// In the order of user interfaces. Properties of each kind: light_model.hpp.
enum class LightKind { kPoint, kSpot, kLuminaire, kRectangle, kDisc, kDirectional };
inline constexpr std::size_t kLightKinds = static_cast<std::size_t>(LightKind::kDirectional) + 1;  // the last kind

// Light in scene coordinates. The first block follows ISO/IEC 14772-1, 4.6.6 and 4.14.
struct Light {
    LightKind kind = LightKind::kDirectional;
    glm::vec3 colour{1};
    glm::vec3 ambient{0};          // added to surfaces of any orientation within the light's range
    glm::dvec3 towards{0, 0, -1};  // direction in which the light travels, unit length; directional and spot
    // All but directional; the centre of area lights.
    glm::dvec3 location{0};
    // Point and spot: factor 1 / max(a.x + a.y * d + a.z * d * d, least_attenuation) at distance d. VRML97 lights never
    // exceed `colour`.
    glm::vec3 attenuation{1, 0, 0};
    float least_attenuation = 1;
    double radius = 100;  // point and spot: no light beyond
    // Spot: full intensity up to `beam_width_rad` from the axis, none beyond `cut_off_rad`.
    double beam_width_rad = kPi / 2;
    double cut_off_rad = kPi / 4;
    // Lights all geometry; otherwise only nodes whose GeometryNode::lights names it.
    bool everywhere = true;
    bool casts_shadows = true;

    // Area lights: half sides of a rectangle, or two radii of a disc. Emission is towards cross(half_u, half_v).
    glm::dvec3 half_u{0.5, 0, 0};
    glm::dvec3 half_v{0, 0, 0.5};

    // Luminaire, in the frame of photometric_web.hpp.
    std::shared_ptr<const Luminaire> luminaire{};
    glm::dmat3 world_from_luminaire{1.0};  // rotation

    std::string name{};  // display name; may be empty
};

/// Directional light with `irradiance` on a surface that faces it. `towards` need not have unit length.
Light directional_light(const glm::dvec3& towards, const glm::vec3& irradiance);
/// Point light with inverse-square falloff at all distances; `intensity` is radiant intensity.
Light point_light(const glm::dvec3& location, const glm::vec3& intensity);
/// Rectangle spanned by two sides from a corner; emits towards their cross product.
Light rectangle_light(const glm::dvec3& corner, const glm::dvec3& side_u, const glm::dvec3& side_v,
                      const glm::vec3& radiance);

/// Area of area lights in square units; 0 for other kinds.
double area_of(const Light& light);

/// Returns true if a point or spot light has inverse-square falloff at all distances, like lights specified in candela.
bool is_inverse_square(const Light& light);

/// Unoccluded irradiance at `position` on a surface that faces the light; 0 for area lights.
glm::vec3 irradiance_at(const Light& light, const glm::dvec3& position);

/// Approximates a light by a point, spot or directional light, for renderers without other kinds: area lights and
/// luminaires become spots with the same intensity along the aim and about the same width, without emission backwards.
Light to_punctual_light(const Light& light);

/// Rotates a light about Y; positive angles from +Z towards +X.
Light rotate_about_y(const Light& light, double angle_rad);

/// Validates a light: finite numbers, non-zero direction and area, luminaire present.
/// \return an error without a file name
Status check_light(const Light& light);

}  // namespace rs
