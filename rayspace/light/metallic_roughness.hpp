#pragma once
// Metallic-roughness materials of glTF 2.0 (3.9.2) and X3D 4 (PhysicalMaterial), without their textures, as a surface
// for ray tracing and as Phong colours for raster rendering. Colours are linear light. Functions are pure and
// thread-safe.

#include "rayspace/api/types/image.hpp"
#include "rayspace/light/surface_properties.hpp"

#include <glm/glm.hpp>

#include <span>

namespace rs {

struct MetallicRoughness {
    glm::vec3 base{1.0F};
    float metallic = 1.0F;
    float roughness = 1.0F;
};

/// Metal or a coated base, by which of both the material is closer to; values are clamped to 0..1.
SurfaceProperties surface_of(const MetallicRoughness& material);

struct PhongColours {
    glm::vec3 diffuse{0.8F};
    glm::vec3 specular{0.0F};
    float exponent = 0.0F;  // of the highlight, 0..128
};
/// Half of a metal's colour stays diffuse: without reflections it would be black except for highlights.
/// \param mean_texture mean colour, as linear light, of the texture or vertex colours that multiply `base`; it colours
/// the highlights of metals
PhongColours phong_colours_of(const MetallicRoughness& material, const glm::vec3& mean_texture = glm::vec3(1));

/// Mean red, green and blue of an image of linear codes, 0..1. Of metallic-roughness textures only the mean counts:
/// green is a factor of the roughness, blue of the metallic.
glm::vec3 mean_of_codes(std::span<const Rgba8> pixels);

/// Mean of an image in sRGB, as linear light.
glm::vec3 mean_linear_colour(std::span<const Rgba8> pixels);

}  // namespace rs
