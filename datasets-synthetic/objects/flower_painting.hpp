#pragma once
// Textures of the potted flower. u runs across a petal or leaf, v from base to tip.

#include "capture/tracer/scene/scene.hpp"

#include <cstdint>

namespace rs::synthetic {

// Dark throat, fine veins that fan out, a pale edge. `hue_turns` as in hue_colour.
capture::Texture paint_petal(float hue_turns, std::uint32_t seed);

// Midrib, side veins, mottled green.
capture::Texture paint_leaf(std::uint32_t seed);

// Fired clay with lime blooming through, turned in fine grooves. Wraps around along u.
capture::Texture paint_terracotta(std::uint32_t seed);

}  // namespace rs::synthetic
