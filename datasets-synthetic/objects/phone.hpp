#pragma once
// A telephone that leans on a metal dock: planes of glass and lacquer with little texture.
// Hard for image-based rendering because most of its surface has no texture for depth estimation, and its reflections
// move with the viewer.
//
// Parameter   default     range            meaning
// text        RAYSPACE    1..8 letters     printed on the back, below a ring
// lean        0.2         0..0.35          angle of the telephone to the vertical, radians
// gloss       0.3         0.05..0.6        roughness of the back's lacquer

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>

namespace rs::synthetic {

Result<capture::Scene> generate_phone(const nlohmann::json& parameters, std::uint64_t seed);

}  // namespace rs::synthetic
