#pragma once
// What people would use today, each codec in all the ways that might be the best for it.

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

// The curves in `names`. Each is tried in all its variants at two settings; the variant that is best for it there is
// measured at all of them. What is in the work folder already is not measured again. Errors: a tool is not installed or
// fails.
Result<std::vector<Measurement>> measure_anchors(const ReferenceImages& images, const std::set<std::string>& names,
                                                 const WorkFolder& work, Progress& progress);

}  // namespace rs::bench
