#pragma once
// Reads textures at surface coordinates: bilinear.

#include "capture/tracer/scene/scene.hpp"

namespace rs::capture {

// uv (0, 0) = the image's lower left corner. The texture must have pixels.
RgbaF sample_texture(const Texture& texture, const glm::vec2& uv);

// Only the alpha channel, at the nearest pixel: holes have crisp edges and cost little to test.
float sample_texture_alpha(const Texture& texture, const glm::vec2& uv);

// Of all pixels, whatever their alpha.
glm::vec3 mean_colour(const Texture& texture);

// The texture coordinate at corner 0 + u (corner 1 - corner 0) + v (corner 2 - corner 0) of a triangle; (0, 0) where
// the mesh has none.
glm::vec2 interpolate_uv(const Mesh& mesh, std::size_t triangle, float u, float v);

// The vertices' colour there; 1 where the mesh has none.
glm::vec3 interpolate_colour(const Mesh& mesh, std::size_t triangle, float u, float v);

// True where some pixel is a hole (alpha below 0.5).
bool has_holes(const Texture& texture);

inline constexpr float kHoleAlpha = 0.5F;

}  // namespace rs::capture
