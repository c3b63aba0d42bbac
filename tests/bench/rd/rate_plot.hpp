#pragma once
// The curves of all sets in one image: a panel per set, rate on a logarithmic axis, one legend for all.
// (rayspace/page/line_plot.hpp draws single plots over linear axes, with fewer colours than there are codecs.)

#include "tests/bench/rd/anchors/best_variant.hpp"
#include "tests/bench/rd/report.hpp"

#include <string>
#include <vector>

namespace rs::bench {

// An image of its own, on white, for a README. Of a curve CODEC-444 only that part is drawn, dashed, where it is
// better than CODEC's.
std::string rate_plot_svg(const std::vector<SetResult>& results);

// Where a logarithmic axis has its marks: 1, 2 and 5 times powers of ten within least..most, 0 < least <= most.
std::vector<double> log_ticks(double least, double most);

}  // namespace rs::bench
