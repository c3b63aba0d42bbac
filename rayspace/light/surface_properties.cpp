#include "rayspace/light/surface_properties.hpp"

#include <algorithm>
#include <cmath>

namespace rs {
namespace {

constexpr float kBlack = 0.05F;            // largest diffuse component of mirrors and metals
constexpr float kMirrorExponent = 120.0F;  // VRML97's shininess ends at 128

float largest(const glm::vec3& colour) {
    return std::max({colour.r, colour.g, colour.b});
}

}  // namespace

float roughness_of_exponent(float exponent) {
    return std::pow(2.0F / (exponent + 2.0F), 0.25F);
}

SurfaceProperties phong_surface(const glm::vec3& diffuse, const glm::vec3& specular, float exponent) {
    SurfaceProperties surface{.colour = diffuse};
    if (!(largest(specular) > 0) || !(exponent > 0)) return surface;
    surface.roughness = roughness_of_exponent(exponent);
    surface.kind = SurfaceKind::glossy;
    // Not brighter than the highlight of a dielectric coat: a dark, glossy plastic.
    if (largest(diffuse) >= kBlack || largest(specular) < 0.3F) return surface;
    surface.kind = exponent >= kMirrorExponent ? SurfaceKind::mirror : SurfaceKind::metal;
    surface.colour = specular;
    return surface;
}

}  // namespace rs
