#pragma once
// Depth from matching costs: semi-global matching (Hirschmüller, "Stereo Processing by Semiglobal Matching and Mutual
// Information", 2008) over eight paths, within the object's pixels and the levels that each may have.

#include "encode/raymap/cost_volume.hpp"
#include "rayspace/image/image.hpp"

namespace rs::encode {

struct SmoothnessOptions {
    int small_step = 2;    // penalty of a change by one level, in units of cost
    int large_step = 250;  // of any larger change; less across an edge of the picture
};

// Levels (with fractions) of the pixels of `view`, transposed as WorkView::columns is; kNoDepth where the volume has
// none.
Image<float> semi_global_levels(const WorkView& view, const CostVolume& volume, const SmoothnessOptions& options);

}  // namespace rs::encode
