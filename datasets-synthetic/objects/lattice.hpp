#pragma once
// A see-through wire sculpture: a cage of enamelled struts (a truncated icosahedron on the sphere) with brass joints, a
// second cage of thin steel inside, and a painted knot as its core. Hard for image-based rendering because rays cross
// several layers: other wires and the core are visible through each opening.
//
// Parameter   default  range         meaning
// strut       0.032    0.015..0.06   radius of the outer struts, relative to a cage of radius 1
// core        0.30     0.15..0.4     radius of the knot's centre line
// windings    3        2..5          of the (2, windings) torus knot in the core; a knot if odd
// hue         0.0      0..1          shift of all the colours, in turns

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>

namespace rs::synthetic {

Result<capture::Scene> generate_lattice(const nlohmann::json& parameters, std::uint64_t seed);

}  // namespace rs::synthetic
