#pragma once
// Parts of the cabin. X points from the nose to the tail; the floor is at y = 0.

#include "tests/bench/scenes/model.hpp"

namespace rs::synthetic {

/// Indices into Model::materials.
struct CabinMaterials {
    int panel = 0, fabric = 1, leather = 2, grey = 3, metal = 4, carpet = 5, aisle = 6, curtain = 7, dark = 8,
        blanket = 9;
};
std::vector<ModelMaterial> cabin_materials();

inline constexpr float kWindowPitch_m = 0.53F;
inline constexpr float kBinLength_m = 1.06F;
inline constexpr float kWallTop_m = 1.55F;

/// Half the width of the cabin at a height.
float cabin_half_width(float height_m);

/// Seat that faces +Z, with its foot at the origin, 0.46 m wide.
ModelGroup cabin_seat();
/// Wall section with a window: x from 0 to kWindowPitch_m, on the side of +Z.
ModelGroup cabin_window(bool shade_down);
/// Overhead bin on the side of +Z, x from 0 to kBinLength_m.
ModelGroup cabin_bin();
/// Reading lights and nozzles above three seats on the side of +Z, centred at x = 0.
ModelGroup service_panel();
/// Half a curtain across the cabin on the side of +Z, at x = 0.
/// \param fringe_triangles 0, or at least 6
ModelGroup curtain(std::int64_t fringe_triangles);

}  // namespace rs::synthetic
