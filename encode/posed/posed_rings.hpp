#pragma once
// Makes rings of synthesized views from posed photos, so that the encoder, which needs rings, makes an object of them:
// visual hull, depth of each photo, one fused surface, views from planned cameras.

#include "encode/posed/hull_volume.hpp"
#include "encode/posed/photo_depth.hpp"
#include "encode/posed/ring_plan.hpp"
#include "encode/posed/view_synthesis.hpp"
#include "encode/set/capture_set.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

namespace rs::encode {

struct PosedOptions {
    HullOptions hull;
    PhotoDepthOptions depth;
    SynthesisOptions synthesis;
    RingPlanOptions rings;
};

/// Returns a set of rings of synthesized views; a set of rings is returned as it is. The numbers of photos, views and
/// rings are appended to CaptureSet::warnings. Errors: those of carve_hull() and plan_rings(), and of reading photos.
/// Memory: 12 bytes per pixel of the photos while their depth is estimated, 8 while views are synthesized; 8 per voxel,
/// and 8 per object pixel of the views (PackedView).
Result<CaptureSet> with_rings(CaptureSet set, const PosedOptions& options = {}, Progress* progress = nullptr);

}  // namespace rs::encode
