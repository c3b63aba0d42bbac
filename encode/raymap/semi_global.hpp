#pragma once
// Depth from matching costs: semi-global matching (Hirschmüller, "Stereo Processing by Semiglobal Matching and Mutual
// Information", 2008) over eight paths, within the object's pixels and the levels that each may have.

#include "encode/raymap/cost_volume.hpp"
#include "rayspace/image/image.hpp"

namespace rs::encode {

struct SmoothnessOptions {
    int small_step = 2;    // penalty P1 of a change by one level, in units of cost
    int large_step = 250;  // penalty P2 of any larger change; less across an edge of the photo
};

/// Computes the depth level of each pixel of `view`, with fractions; kNoDepth where the volume has no levels.
/// Transposed as WorkView::columns is.
Image<float> semi_global_levels(const WorkView& view, const CostVolume& volume, const SmoothnessOptions& options);

}  // namespace rs::encode
