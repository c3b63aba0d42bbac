#include "capture/photos/background/revolution_rows.hpp"

#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <algorithm>
#include <cmath>

namespace rs::capture {
namespace {

constexpr float kMostlySeen = 0.5F;    // of the samples: arms pass in front of a body
constexpr float kRowEdge_delta_e = 8;  // across a pixel
constexpr double kStillOfRow = 0.3;    // what is drawn on it moves
constexpr int kFewEdges = 2;           // a highlight has two
constexpr int kOutline_px = 3;

}  // namespace

RevolutionRows::RevolutionRows(const StillPicture& still, double axis_px)
    : twice_axis_px_(static_cast<int>(std::lround(2 * axis_px))),
      still_(still.colour.width() + 1, still.colour.height()),
      edges_(still_.width(), still_.height()) {
    for_each_index(still.colour.height(), [&](int y) {
        const int width = still.colour.width();
        const auto rests = [&](int x) { return still.agreement(x, y) >= kMostlySeen; };
        const auto look = [&](int x) { return lab_from_linear(linear_rgb(still.colour(x, y))); };
        bool goes_on = false;  // an edge is a few pixels wide
        for (int x = 0; x < width; ++x) {
            const bool is_edge = x >= 2 && x + 1 < width && rests(x - 2) && rests(x + 1) &&
                                 delta_e(look(x - 2), look(x + 1)) > kRowEdge_delta_e;
            still_(x + 1, y) = still_(x, y) + (rests(x) ? 1 : 0);
            edges_(x + 1, y) = edges_(x, y) + (is_edge && !goes_on ? 1 : 0);
            goes_on = is_edge;
        }
    });
}

bool RevolutionRows::may_be_body(int x, int y) const {
    const int other = mirrored(x);
    const int from = std::max(0, std::min(x, other) + kOutline_px);
    const int to = std::min(edges_.width() - 1, std::max(x, other) + 1 - kOutline_px);
    if (from >= to) return true;
    return still_(to, y) - still_(from, y) >= kStillOfRow * (to - from) && edges_(to, y) - edges_(from, y) <= kFewEdges;
}

bool alike_in_some_light(const LinearRgb& a, const LinearRgb& b) {
    constexpr float kDarkest = 0.25F, kLightest = 4;
    constexpr float kUnlike_delta_e = 10;
    return explain_by_backdrop(a, b, kDarkest, kLightest).shaded < kUnlike_delta_e;
}

}  // namespace rs::capture
