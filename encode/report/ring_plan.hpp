#pragma once
// The rings of a capture set seen from above, as inline SVG: where the cameras stand, and which sectors they miss.

#include "rayspace/geometry/rig.hpp"

#include <string>
#include <vector>

namespace rs::encode {

// A sector of a ring that no camera looks from; turning from +Z towards +X.
struct MissingSector {
    double from_rad = 0;
    double to_rad = 0;  // > from_rad; beyond 2 pi where the sector crosses +Z
};

// Steps between neighbouring views of one ring (`azimuths_rad` in turning order, 0 <= a < 2 pi) that are more than 1.75
// times their median, so that one image missing from an even turn is seen. Nothing for fewer than three views.
std::vector<MissingSector> missing_sectors(const std::vector<double>& azimuths_rad);

// +Z, where a turn begins, is at the bottom, +X to the right: what one sees who looks down on the turntable from behind
// the first camera. Missing sectors are marked in --bad of HtmlPage's style, the object's radius is a disc.
std::string svg_of_rings(const Rig& rig);

// One line for each missing sector of each ring: "from 120.0 to 150.0 degrees (ring 1)".
std::vector<std::string> describe_missing_sectors(const Rig& rig);

}  // namespace rs::encode
