#pragma once
// The RS map of the paper (section 2, "nearest neighbour"): for each cell (x, u) of each reference plane, the captured
// photo whose ray through the plane point x is nearest in angle. The object is assumed to lie on the plane.

#include "rayspace/geometry/rig.hpp"
#include "rayspace/object/ray_space_object.hpp"

namespace rs::encode {

struct PlaneMapOptions {
    int planes = 12;    // kMinPlanes..kMaxPlanes
    int x_cells = 512;  // 1..kMaxMapSide
    int u_cells = 512;  // 1..kMaxMapSide
};

/// Computes the map of one ring. A photo is a candidate for the plane point x if it sees the point from the front of
/// the plane and within its frame. Of two photos that are almost equally near (within two cells of u, and an eighth of
/// their distance) the first in turning order is chosen, so that halfway viewpoints show one photo instead of stripes
/// of both. Cells without a candidate hold kNoImage. `upright` is in object radii. Deterministic.
Ring make_plane_map(const Rig& upright, const ViewRing& ring, const PlaneMapOptions& options);

/// The smallest number of u cells between two neighboring views on any plane at x = 0; 0 where the ring has one view.
/// Below 2, captured poses may be rendered from a neighbor.
double cells_between_views(const Rig& upright, const ViewRing& ring, const PlaneMapOptions& options);

}  // namespace rs::encode
