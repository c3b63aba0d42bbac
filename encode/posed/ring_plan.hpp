#pragma once
// Plan of the rings of upright cameras whose synthesized views make a ray-space object.
//
// A view is rendered best by a ring at its own elevation and distance, so the cameras stand as far from the object as
// the photos' cameras do, at all elevations that the photos have. Upright images are stretched along their rows by the
// tangent of the elevation. Views from above and below therefore come from a cap: arcs of upright cameras about an
// axis across the object's.

#include "encode/posed/posed_photo.hpp"
#include "encode/posed/signed_volume.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/rig.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rs::encode {

struct RingPlanOptions {
    double step_deg = 10;                               // largest distance of two rings
    double steepest_deg = 50;                           // elevation of a ring about the object's axis
    double steepest_turn_deg = 65;                      // turns up to here keep their photos' cameras
    int views = 48;                                     // of a level ring; they are as dense in the others
    double least_distance_radii = 1.6;                  // from a ring's axis
    std::int64_t memory_bytes = std::int64_t{2} << 30;  // of all views at 8 bytes per pixel, before packing
};

struct RingPlan {
    Rig rig;  // views of all rings, in the object's axes, with object_radius
    std::vector<ViewRing> rings;
    std::vector<int> photos;                 // [view]: the photo from the same centre, -1: none
    double lowest_deg = 0, highest_deg = 0;  // 90: there is a cap
};

/// Plans rings for the elevations that the photos have, but for the outermost of many. Error: the views take more than
/// the memory even at half of the photos' density.
Result<RingPlan> plan_rings(std::span<const PosedPhoto> photos, const SignedVolume::Bounds& object,
                            const RingPlanOptions& options);

}  // namespace rs::encode
