#pragma once
// A potted flower: thin, curved, translucent petals and leaves on bent stems in a terracotta pot. Hard for image-based
// rendering because of the gaps between all parts: neighbouring rays hit different petals.
//
// Parameter   default  range       meaning
// blooms      7        1..12       open flowers
// petals      13       6..24       in the outer ring of a flower
// leaves      40       0..60       on stems and at their base
// spread      0.62     0.2..0.9    outward lean of the stems, share of their height
// hue         0.93     0..1        of the first flower, in turns (0 red, 1/3 green, 2/3 blue); the others are near it

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>

namespace rs::synthetic {

// Textures of the potted flower. u runs across a petal or leaf, v from base to tip.

// Dark throat, fine veins that fan out, a pale edge. `hue_turns` as in hue_colour.
capture::Texture paint_petal(float hue_turns, std::uint32_t seed);

// Midrib, side veins, mottled green.
capture::Texture paint_leaf(std::uint32_t seed);

// Fired clay with lime blooming through, turned in fine grooves. Wraps around along u.
capture::Texture paint_terracotta(std::uint32_t seed);

Result<capture::Scene> generate_flower(const nlohmann::json& parameters, std::uint64_t seed);

}  // namespace rs::synthetic
