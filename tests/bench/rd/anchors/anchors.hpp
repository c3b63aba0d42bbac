#pragma once
// Anchors: established codecs, each measured with the variants that may be its best.

#include "rayspace/base/progress.hpp"
#include "tests/bench/rd/coded.hpp"
#include "tests/bench/rd/curve.hpp"
#include "tests/bench/rd/work_folder.hpp"

#include <set>
#include <string>
#include <vector>

namespace rs::bench {

// Curve names: astc (RGB, alpha not coded), astc-rgba, jpeg, webp, x265-intra, x265-inter (both 4:2:0),
// x265-intra-444, x265-inter-444.
const std::vector<std::string>& anchor_names();

/// Measures the curves in `names`. All variants are probed at two settings; the best one is measured at all settings.
/// Results in the work folder are reused. Fails if a tool is not installed or fails.
Result<std::vector<Measurement>> measure_anchors(const ReferenceImages& images, const std::set<std::string>& names,
                                                 const WorkFolder& work, Progress& progress);

}  // namespace rs::bench
