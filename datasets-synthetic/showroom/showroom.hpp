#pragma once
// The showroom: a shop and a museum room with the procedural objects on shelves, tables and plinths, and a camera path
// through both.

#include "datasets-synthetic/showroom/world.hpp"

namespace rs::synthetic {

struct ShowroomOptions {
    float texture_scale = 1.0F;  // (0, 1]: factor on the textures' resolutions
};

// Deterministic. About 10,000 triangles. Thread-safe. Takes a few seconds at full texture size.
World make_showroom(const ShowroomOptions& options = {});

// The doorway between the rooms, through the wall from z = -kWallBetween_m to 0.
inline constexpr float kDoorHalf_m = 0.9F;
inline constexpr float kDoorHeight_m = 2.45F;
inline constexpr float kWallBetween_m = 0.3F;

// The shop: shelves on either side, a table on a rug, a counter under lamps, a window to the street, a doorway to the
// museum in the wall at z = 0. It extends from x = -4 to 4 and z = 0 to 7. Requires add_furniture_looks().
// `texture_scale`: see RoomBuilder.
void build_shop(World& world, float texture_scale);

// The museum beyond the shop's doorway: a panelled room under a skylight with plinths, rope posts, paintings and a
// bench, from x = -5 to 5 and from z = -9.3 to -0.3. Requires add_furniture_looks(). `texture_scale`: see RoomBuilder.
void build_museum(World& world, float texture_scale);

}  // namespace rs::synthetic
