#pragma once
// A sitting teddy bear with real fur: tens of thousands of thin bent strands over a body of ellipsoids, glossy eyes, a
// bow. Hard for image-based rendering because the silhouette has subpixel detail and no surface is smooth enough for
// matching.
//
// Parameter    default  range            meaning
// strands      75000    1000..140000     hairs; seven triangles each
// hair_length  0.085    0.03..0.16       relative to a body about 2 high
// curl         0.55     0..1.5           bend of the hairs
// hue          0.075    0..1             of the fur, in turns (0 red, 1/3 green, 2/3 blue)

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>

namespace rs::synthetic {

Result<capture::Scene> generate_doll(const nlohmann::json& parameters, std::uint64_t seed);

}  // namespace rs::synthetic
