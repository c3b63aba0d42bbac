#pragma once
// Reflection of a surface of any origin (glTF, MTL, VRML97) for ray tracing, without its textures. Colours are linear
// light.

#include <glm/glm.hpp>

namespace rs {

enum class SurfaceKind {
    diffuse,  // Lambert
    glossy,   // a GGX dielectric coat (ior, roughness) over a Lambert base of `colour`
    metal,    // GGX conductor, reflectance at normal incidence `colour`, roughness
    mirror,   // perfectly smooth, reflectance `colour`
    // Smooth dielectric interface (ior); the transmittance inside is `colour` per unit length. In nested glass the
    // innermost one absorbs (up to 4 levels), but each surface refracts as if against air.
    glass,
};

struct SurfaceProperties {
    SurfaceKind kind = SurfaceKind::diffuse;
    glm::vec3 colour{0.8F};    // 0..1, multiplied by the texture and the vertex colours
    float roughness = 0.3F;    // GGX alpha = roughness^2; 0..1
    float ior = 1.5F;          // 1..10
    glm::vec3 emission{0.0F};  // radiance, >= 0, multiplied by the emission texture
    bool operator==(const SurfaceProperties&) const = default;
};

/// GGX roughness of a highlight as wide as that of a Phong lobe: alpha = sqrt(2 / (exponent + 2)) (B. Walter and
/// others, "Microfacet Models for Refraction through Rough Surfaces", 2007).
float roughness_of_exponent(float exponent);

/// Surface of a Phong material without further data: a black diffuse colour makes a mirror or, with a wide highlight, a
/// metal; a specular colour makes a coat.
/// \param exponent of the highlight, >= 0
SurfaceProperties phong_surface(const glm::vec3& diffuse, const glm::vec3& specular, float exponent);

}  // namespace rs
