#pragma once
// Halls: a barrel vault on two rows of fluted columns, arched windows, a flight of stairs with turned balusters to a
// gallery, tables with chairs, benches, chandeliers and plants. Triangle counts are those of published measurements of
// Whitted ray tracing in a CAVE.

#include "tests/bench/scenes/model.hpp"

namespace rs::synthetic {

/// Exact triangle counts.
inline constexpr std::int64_t kHallTriangles = 66'450;
inline constexpr std::int64_t kGreatHallTriangles = 150'220;

/// Deterministic. Plants are sized to reach the exact number of triangles.
Model make_hall();
Model make_great_hall();

}  // namespace rs::synthetic
