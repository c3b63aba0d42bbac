#pragma once
// A see-through wire sculpture: a cage of enamelled struts (a truncated icosahedron on the sphere) with brass joints, a
// second cage of thin steel within, and a painted knot as its core. Hard for image-based rendering because one ray of
// depth is never enough: through each opening one sees other wires and the core.
//
// Parameter   default  range         meaning
// strut       0.032    0.015..0.06   radius of the outer struts, relative to a cage of radius 1
// core        0.30     0.15..0.4     radius of the knot's middle line
// windings    3        2..5          of the core's knot: it goes round twice while winding so often (odd numbers are
// knots) hue         0.0      0..1          shift of all the colours, in turns

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>

namespace rs::synthetic {

Result<capture::Scene> generate_lattice(const nlohmann::json& parameters, std::uint64_t seed);

}  // namespace rs::synthetic
