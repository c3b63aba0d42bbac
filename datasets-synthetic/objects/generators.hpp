#pragma once
// Generators of the procedural objects, each in a file of its own; generate() (datasets-synthetic/objects.hpp) selects
// one by name. `parameters` is a JSON object with some of the parameters listed, or null for all defaults. Errors: an
// unknown parameter, or a value out of range. Thread-safe.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>

namespace rs::synthetic {

/// A painted porcelain vase: a surface of revolution with a wall of real thickness, open at the top, under a glossy
/// coat. Hard for image-based rendering because highlights move over the painting with the viewpoint.
///
/// Parameter   default  range        meaning
/// height      2.2      1.8..2.8     foot to lip
/// belly       0.66     0.5..0.8     largest radius
/// neck        0.22     0.15..0.32   smallest radius above the belly
/// flowers     5        3..8         pairs of peonies around the belly
/// roughness   0.12     0.02..0.6    of the glaze
/// Lengths are relative: the object is scaled to radius 1.
Result<capture::Scene> generate_vase(const nlohmann::json& parameters, std::uint64_t seed);

/// A potted flower: thin, curved, translucent petals and leaves on bent stems in a terracotta pot. Hard for image-based
/// rendering because of the gaps between all parts: neighbouring rays hit different petals.
///
/// Parameter   default  range       meaning
/// blooms      7        1..12       open flowers
/// petals      13       6..24       in the outer ring of a flower
/// leaves      40       0..60       on stems and at their base
/// spread      0.62     0.2..0.9    outward lean of the stems, share of their height
/// hue         0.93     0..1        of the first flower, in turns (0 red, 1/3 green, 2/3 blue); the others are near it
Result<capture::Scene> generate_flower(const nlohmann::json& parameters, std::uint64_t seed);

/// A sitting teddy bear with real fur: tens of thousands of thin bent strands over a body of ellipsoids, glossy eyes, a
/// bow. Hard for image-based rendering because the silhouette has subpixel detail and no surface is smooth enough for
/// matching.
///
/// Parameter    default  range            meaning
/// strands      75000    1000..140000     hairs; seven triangles each
/// hair_length  0.085    0.03..0.16       relative to a body about 2 high
/// curl         0.55     0..1.5           bend of the hairs
/// hue          0.075    0..1             of the fur, in turns (0 red, 1/3 green, 2/3 blue)
Result<capture::Scene> generate_doll(const nlohmann::json& parameters, std::uint64_t seed);

/// An oil lamp: a glass font with coloured oil and a slender glass chimney on a turned brass stand with glass feet;
/// lit. Hard for image-based rendering because refractions in glass and reflections in brass do not lie on any surface.
///
/// Parameter   default  range       meaning
/// hue         0.985    0..1        of the oil, in turns (0 red, 1/3 green, 2/3 blue)
/// fill        0.62     0.1..0.9    fill level of the font
/// flame       5        0..20       radiance of the flame; 0 = not lit
/// polish      0.8      0..1        of the brass: 0 brushed, 1 a mirror
///
/// Every glass part is a separate closed surface with outward normals. The oil is slightly smaller than the font's
/// inside, so that no two surfaces coincide.
Result<capture::Scene> generate_lamp(const nlohmann::json& parameters, std::uint64_t seed);

/// A see-through wire sculpture: a cage of enamelled struts (a truncated icosahedron on the sphere) with brass joints,
/// a second cage of thin steel inside, and a painted knot as its core. Hard for image-based rendering because rays
/// cross several layers: other wires and the core are visible through each opening.
///
/// Parameter   default  range         meaning
/// strut       0.032    0.015..0.06   radius of the outer struts, relative to a cage of radius 1
/// core        0.30     0.15..0.4     radius of the knot's centre line
/// windings    3        2..5          of the (2, windings) torus knot in the core; a knot if odd
/// hue         0.0      0..1          shift of all the colours, in turns
Result<capture::Scene> generate_lattice(const nlohmann::json& parameters, std::uint64_t seed);

/// A tower of wooden letter blocks: planar faces, straight edges, sharp painted signs.
/// Hard for image-based rendering because depth errors visibly bend straight lines or double edges.
///
/// Parameter   default     range            meaning
/// text        RAYSPACE    1..12 letters    painted around the blocks
/// bevel       0.09        0.03..0.25       radius of the rounded edges, share of half a side
/// untidiness  0.6         0..1             random rotation and shift of the blocks
/// gloss       0.25        0.05..0.6        roughness of the varnish
Result<capture::Scene> generate_blocks(const nlohmann::json& parameters, std::uint64_t seed);

/// A telephone that leans on a metal dock: planes of glass and lacquer with little texture.
/// Hard for image-based rendering because most of its surface has no texture for depth estimation, and its reflections
/// move with the viewer.
///
/// Parameter   default     range            meaning
/// text        RAYSPACE    1..8 letters     printed on the back, below a ring
/// lean        0.2         0..0.35          angle of the telephone to the vertical, radians
/// gloss       0.3         0.05..0.6        roughness of the back's lacquer
Result<capture::Scene> generate_phone(const nlohmann::json& parameters, std::uint64_t seed);

}  // namespace rs::synthetic
