#pragma once
// Groups the views of a rig into rings about the Y axis.

#include "rayspace/geometry/rig.hpp"

#include <vector>

namespace rs::encode {

struct ViewRing {
    double elevation_rad = 0;  // mean, above the horizontal plane through the origin
    std::vector<int> views;    // in turning order, from +Z towards +X
};

/// Sorts views by the elevation of their centres; a gap of more than 5 degrees starts a new ring.
std::vector<ViewRing> find_rings(const Rig& rig);

}  // namespace rs::encode
