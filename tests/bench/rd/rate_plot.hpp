#pragma once
// Plots the curves of all sets in one image: a panel per set, logarithmic rate axis, one common legend.
// (rayspace/page/plots.hpp draws single plots with linear axes and too few colours.)

#include "tests/bench/rd/anchors/best_variant.hpp"
#include "tests/bench/rd/report.hpp"

#include <string>
#include <vector>

namespace rs::bench {

/// SVG file on a white background. A curve CODEC-444 is drawn dashed, and only where it is better than CODEC's.
std::string rate_plot_svg(const std::vector<SetResult>& results);

/// Tick marks of a logarithmic axis: 1, 2 and 5 times powers of ten within least..most, 0 < least <= most.
std::vector<double> log_ticks(double least, double most);

}  // namespace rs::bench
