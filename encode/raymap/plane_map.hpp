#pragma once
// The paper's RS map: for every cell (x, u) of every reference plane, the captured picture whose ray through the plane
// point x is nearest in angle; the object is taken to lie on the plane (section 2, "nearest neighbour").

#include "encode/raymap/rings.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/object/ray_space_object.hpp"

namespace rs::encode {

struct PlaneMapOptions {
    int planes = 12;    // kMinPlanes..kMaxPlanes
    int x_cells = 512;  // 1..kMaxMapSide
    int u_cells = 512;  // 1..kMaxMapSide
};

// `upright` is in object radii. A picture can answer for the plane point x when it sees it from the front of the plane
// and within its frame. Of two pictures that are almost equally near (within two cells of u, and an eighth of their
// distance) the one that comes first in turning order answers, so that half-way viewpoints see one picture instead of
// stripes of both. Cells that no picture can answer hold kNoPicture. Deterministic.
Ring make_plane_map(const Rig& upright, const ViewRing& ring, const PlaneMapOptions& options);

// The narrowest run of u cells that separates two neighbouring views on any plane at x = 0: below 2, captured poses may
// be answered by a neighbour. 0 where the ring has one view.
double cells_between_views(const Rig& upright, const ViewRing& ring, const PlaneMapOptions& options);

}  // namespace rs::encode
