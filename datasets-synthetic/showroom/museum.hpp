#pragma once
// The museum beyond the shop's doorway: a panelled room under a skylight with plinths, rope posts, paintings and a
// bench, from x = -5 to 5 and from z = -9.3 to -0.3.

#include "datasets-synthetic/showroom/world.hpp"

namespace rs::synthetic {

// Requires add_furniture_looks(). `texture_scale`: see RoomBuilder.
void build_museum(World& world, float texture_scale);

}  // namespace rs::synthetic
