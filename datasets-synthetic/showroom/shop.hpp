#pragma once
// The shop: shelves on either side, a table on a rug, a counter under lamps, a window to the street, a doorway to the
// museum in the wall at z = 0. It extends from x = -4 to 4 and z = 0 to 7.

#include "datasets-synthetic/showroom/world.hpp"

namespace rs::synthetic {

// The doorway between the rooms, through the wall from z = -kWallBetween_m to 0.
inline constexpr float kDoorHalf_m = 0.9F;
inline constexpr float kDoorHeight_m = 2.45F;
inline constexpr float kWallBetween_m = 0.3F;

// Requires add_furniture_looks(). `texture_scale`: see RoomBuilder.
void build_shop(World& world, float texture_scale);

}  // namespace rs::synthetic
