#pragma once
// Plan of the rings of upright cameras whose synthesized views make a ray-space object.
//
// Upright images of a steep camera are stretched along their rows: by the tangent of its elevation, and unevenly where
// it is near. So the cameras stand at one horizontal distance from the axis, several object radii, at any elevation,
// and their vertical focal length is shorter by the elevation's cosine: rows and columns are as dense on the object as
// the photos' pixels.

#include "encode/posed/posed_photo.hpp"
#include "encode/posed/signed_volume.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/rig.hpp"

#include <cstdint>
#include <span>

namespace rs::encode {

struct RingPlanOptions {
    double step_deg = 15;     // largest distance of two rings
    double highest_deg = 75;  // rings nearer to the vertical show what this ring does
    int views = 48;           // of a level ring; fewer in steep rings, whose cameras are nearer to each other
    int least_views = 24;
    double distance_radii = 6;                          // from the axis, horizontally
    std::int64_t memory_bytes = std::int64_t{2} << 30;  // of all views at 8 bytes per pixel
};

struct RingPlan {
    Rig rig;  // of all rings, upright, with object_radius
    int rings = 0;
    double lowest_deg = 0, highest_deg = 0;
};

/// Plans rings for the elevations that the photos have, but for the outermost of many. Error: the views take more than
/// the memory even at half of the photos' density.
Result<RingPlan> plan_rings(std::span<const PosedPhoto> photos, const SignedVolume::Bounds& object,
                            const RingPlanOptions& options);

}  // namespace rs::encode
