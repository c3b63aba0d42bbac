#pragma once
// A light, wherever it comes from (VRML97, glTF, a recipe, a list of lights) and whoever draws by it (raster, tracer).
//
// Colours are linear light and may exceed 1. What `colour` means, by kind:
//   directional, point, spot   the radiance of a white matte surface that faces the light where nothing is attenuated,
//                              as VRML97's formula has it: irradiance / pi
//   rectangle, disc            the radiance of the area itself
//   luminaire                  a factor on its photometric web, whose radiant intensity is candela / kLumensPerWatt

#include "rayspace/base/conventions.hpp"
#include "rayspace/light/luminaire.hpp"

#include <glm/glm.hpp>

#include <limits>
#include <memory>
#include <string>

namespace rs {

// In the order in which people are offered them. What each is: light_model.hpp.
enum class LightKind { kPoint, kSpot, kLuminaire, kRectangle, kDisc, kDirectional };
inline constexpr std::size_t kLightKinds = static_cast<std::size_t>(LightKind::kDirectional) + 1;  // the last of them

// In scene coordinates. The first block is ISO/IEC 14772-1, 4.6.6 and 4.14.
struct Light {
    LightKind kind = LightKind::kDirectional;
    glm::vec3 colour{1};
    glm::vec3 ambient{0};          // what it adds everywhere that it reaches, whatever the surface's direction
    glm::dvec3 towards{0, 0, -1};  // the direction in which the light travels, unit length; directional and spot
    // All but directional ones; the middle of areas.
    glm::dvec3 location{0};
    // Points and spots: falls off as 1 / max(a.x + a.y * d + a.z * d * d, least_attenuation) at distance d; VRML97's
    // light is nowhere above `colour`.
    glm::vec3 attenuation{1, 0, 0};
    float least_attenuation = 1;
    double radius = 100;  // no light beyond; points and spots
    // Spots only: full light up to `beam_width_rad` from the axis, none beyond `cut_off_rad`.
    double beam_width_rad = kPi / 2;
    double cut_off_rad = kPi / 4;
    // Reaches all geometry; else only that whose GeometryNode::lights names it.
    bool everywhere = true;

    // Areas: the halves of a rectangle's sides, or two radii of a disc. They shine to where cross(half_u, half_v)
    // points.
    glm::dvec3 half_u{0.5, 0, 0};
    glm::dvec3 half_v{0, 0, 0.5};

    // Luminaires, in the frame of photometric_web.hpp.
    std::shared_ptr<const Luminaire> luminaire{};
    glm::dmat3 world_from_luminaire{1.0};  // rotation

    std::string name{};  // for people; may be empty
};

// A light from far away, `irradiance` on a surface that faces it. `towards` need not have unit length.
Light directional_light(const glm::dvec3& towards, const glm::vec3& irradiance);
// Radiant intensity over the square of the distance, however near or far.
Light point_light(const glm::dvec3& location, const glm::vec3& intensity);
// From a corner along two sides; shines to where their cross product points.
Light rectangle_light(const glm::dvec3& corner, const glm::dvec3& side_u, const glm::dvec3& side_v,
                      const glm::vec3& radiance);

// Of area lights, in square units; else 0.
double area_of(const Light& light);

// Of a point or spot: whether it falls off by the square of the distance, however near, as lights of so many candelas
// do.
bool is_inverse_square(const Light& light);

// Irradiance at `position`, which faces the light, with nothing in between; 0 where none arrives. Areas give 0: they
// are no point.
glm::vec3 irradiance_at(const Light& light, const glm::dvec3& position);

// What comes nearest to the light among points, spots and directional lights, for renderers that know no others: what
// is none of them becomes a spot of the same intensity along its aim and about the same width, with no light behind.
Light punctual_of(const Light& light);

// The light turned about Y; positive angles take +Z to +X.
Light turned_about_y(const Light& light, double angle_rad);

// Why the light cannot be used, without a file's name; nothing where it can: numbers that are not finite, a direction
// or an area of nothing, a luminaire that is not there.
Status check_light(const Light& light);

}  // namespace rs
