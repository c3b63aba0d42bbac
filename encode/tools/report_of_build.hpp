#pragma once
// Gathers what the page of a build shows of a capture set (encode/report/build_report.hpp).

#include "encode/raymap/shape_map.hpp"
#include "encode/report/build_report.hpp"
#include "encode/set/capture_set.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <vector>

namespace rs::encode {

// Some of the set's pictures, small. Fails as read_upright_picture does.
Status add_captured_pictures(const CaptureSet& set, BuildReport& report);

// Builds objects from every other view, scores the rest and keeps some of the answers. A set with too few views is no
// error: the report says so.
Status add_held_out_views(const CaptureSet& set, int planes, BuildReport& report, Progress* progress);

// Hull and depth of a few views, as build_object() found them.
void add_depths(const CaptureSet& set, const std::vector<FoundDepth>& depths, BuildReport& report);

}  // namespace rs::encode
