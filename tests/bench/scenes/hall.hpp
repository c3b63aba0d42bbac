#pragma once
// Halls of architecture: a barrel vault on two rows of fluted columns, arched windows, a flight of stairs with turned
// balusters to a gallery, tables with chairs, benches, chandeliers and plants. As large as the two halls that Whitted's
// ray tracing was measured on in a CAVE.

#include "tests/bench/scenes/model.hpp"

namespace rs::synthetic {

// Triangles, exactly.
inline constexpr std::int64_t kHallTriangles = 66'450;
inline constexpr std::int64_t kGreatHallTriangles = 150'220;

// The same bits every time. Plants take what the rest leaves of the number.
Model make_hall();
Model make_great_hall();

}  // namespace rs::synthetic
