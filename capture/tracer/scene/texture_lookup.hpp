#pragma once
// Texture look-up and interpolation of vertex attributes.

#include "capture/tracer/scene/scene.hpp"

namespace rs::capture {

/// Bilinear look-up; uv (0, 0) is the image's lower left corner. The texture must not be empty.
RgbaF sample_texture(const Texture& texture, const glm::vec2& uv);

/// Alpha of the nearest pixel, for holes with sharp edges.
float sample_texture_alpha(const Texture& texture, const glm::vec2& uv);

/// Mean colour of all pixels, ignoring alpha.
glm::vec3 mean_colour(const Texture& texture);

/// Texture coordinate at corner 0 + u (corner 1 - corner 0) + v (corner 2 - corner 0) of a triangle; (0, 0) if the mesh
/// has none.
glm::vec2 interpolate_uv(const Mesh& mesh, std::size_t triangle, float u, float v);

/// Vertex colour at the same point; 1 if the mesh has none.
glm::vec3 interpolate_colour(const Mesh& mesh, std::size_t triangle, float u, float v);

/// Returns true if any pixel is a hole (alpha below kHoleAlpha).
bool has_holes(const Texture& texture);

inline constexpr float kHoleAlpha = 0.5F;

}  // namespace rs::capture
