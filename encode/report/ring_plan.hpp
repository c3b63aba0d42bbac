#pragma once
// Plan of a capture set's rings as inline SVG: camera positions seen from above, and sectors without cameras.

#include "rayspace/geometry/rig.hpp"

#include <string>
#include <vector>

namespace rs::encode {

/// A sector of a ring without cameras; angles from +Z towards +X.
struct MissingSector {
    double from_rad = 0;
    double to_rad = 0;  // > from_rad; beyond 2 pi where the sector crosses +Z
};

/// Finds the steps between neighbouring views of one ring that exceed 1.75 times their median, so that a single missing
/// photo of a uniform turn is found. Empty for fewer than three views.
/// \param azimuths_rad  in turning order, 0 <= a < 2 pi.
std::vector<MissingSector> find_missing_sectors(const std::vector<double>& azimuths_rad);

/// Draws the plan: +Z, where a turn begins, at the bottom, +X to the right, as seen from above from behind the first
/// camera. Missing sectors have the colour --bad of HtmlPage's style; a disc shows the object's radius.
std::string draw_ring_plan(const Rig& rig);

/// One line per missing sector of each ring: "from 120.0 to 150.0 degrees (ring 1)".
std::vector<std::string> describe_missing_sectors(const Rig& rig);

}  // namespace rs::encode
