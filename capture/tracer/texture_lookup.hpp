#pragma once
// Reads textures at surface coordinates: bilinear, repeating in both directions.

#include "capture/tracer/scene.hpp"

namespace rs::capture {

// uv (0, 0) = the picture's lower left corner. The texture must have pixels.
RgbaF sample_texture(const Texture& texture, const glm::vec2& uv);

// Only the alpha channel, at the nearest pixel: holes have crisp edges and cost little to test.
float sample_texture_alpha(const Texture& texture, const glm::vec2& uv);

// True where some pixel is a hole (alpha below 0.5).
bool has_holes(const Texture& texture);

inline constexpr float kHoleAlpha = 0.5F;

}  // namespace rs::capture
