#pragma once
// Gathers what the page of a build shows of a capture set (encode/report/build_report.hpp).

#include "encode/capture_set.hpp"
#include "encode/report/build_report.hpp"
#include "rayspace/progress.hpp"
#include "rayspace/result.hpp"

namespace rs::encode {

// Some of the set's pictures, small. Fails as read_upright_picture does.
Status add_captured_pictures(const CaptureSet& set, BuildReport& report);

// Builds objects from every other view, scores the rest and keeps some of the answers. A set with too few views is no
// error: the report says so.
Status add_held_out_views(const CaptureSet& set, int planes, BuildReport& report, Progress* progress);

}  // namespace rs::encode
