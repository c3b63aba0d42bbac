#pragma once
// An oil lamp: a glass font with coloured oil and a slender glass chimney on a turned brass stand with glass feet; lit.
// Hard for image-based rendering because refractions in glass and reflections in brass do not lie on any surface.
//
// Parameter   default  range       meaning
// hue         0.985    0..1        of the oil, in turns (0 red, 1/3 green, 2/3 blue)
// fill        0.62     0.1..0.9    fill level of the font
// flame       5        0..20       radiance of the flame; 0 = not lit
// polish      0.8      0..1        of the brass: 0 brushed, 1 a mirror
//
// Every glass part is a separate closed surface with outward normals. The oil is slightly smaller than the font's
// inside, so that no two surfaces coincide.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>

namespace rs::synthetic {

Result<capture::Scene> generate_lamp(const nlohmann::json& parameters, std::uint64_t seed);

}  // namespace rs::synthetic
