#include "capture/photos/background/revolution_rows.hpp"

#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rs::capture {
namespace {

constexpr float kMostlySeen = 0.5F;    // of the samples: arms pass in front of a body
constexpr float kRowEdge_delta_e = 8;  // from one pixel to the third after it
constexpr double kStillOfRow = 0.3;    // at least; what is drawn on a body moves
constexpr int kFewEdges = 2;           // a highlight has two
constexpr int kOutline_px = 3;
constexpr double kEvenShare = 0.5;   // at most so many edges of a body for each that the room has beside it
constexpr double kFewestBeside = 1;  // as wide a piece of a room has; an even backdrop has fewer
constexpr int kRowsNear = 16;        // one in so many of all rows, up and down, are near

}  // namespace

RevolutionRows::RevolutionRows(const StillPicture& still, ConstImageView<std::uint8_t> untouched, double axis_px)
    : twice_axis_px_(static_cast<int>(std::lround(2 * axis_px))),
      still_(still.colour.width() + 1, still.colour.height()),
      edges_(still_.width(), still_.height()),
      edges_beside_(static_cast<std::size_t>(still_.height())) {
    const int width = still.colour.width(), height = still.colour.height();
    RS_CHECK(untouched.width() == width && untouched.height() == height);
    struct Beside {
        int pixels = 0, edges = 0;
    };
    std::vector<Beside> beside(edges_beside_.size());
    for_each_index(height, [&](int y) {
        std::vector<Lab> looks;
        for (int x = 0; x < width; ++x) looks.push_back(lab_from_linear(linear_rgb(still.colour(x, y))));
        const auto rests = [&](int x) { return still.agreement(x, y) >= kMostlySeen; };
        const auto look = [&](int x) { return looks[static_cast<std::size_t>(x)]; };
        bool goes_on = false;  // an edge is a few pixels wide
        for (int x = 0; x < width; ++x) {
            const bool is_edge = x >= 2 && x + 1 < width && rests(x - 2) && rests(x + 1) &&
                                 delta_e(look(x - 2), look(x + 1)) > kRowEdge_delta_e;
            const bool begins = is_edge && !goes_on;
            still_(x + 1, y) = still_(x, y) + (rests(x) ? 1 : 0);
            edges_(x + 1, y) = edges_(x, y) + (begins ? 1 : 0);
            goes_on = is_edge;
            if (untouched(x, y) == 0) continue;
            ++beside[static_cast<std::size_t>(y)].pixels;
            const bool whole = begins && untouched(x - 2, y) != 0 && untouched(x + 1, y) != 0;
            beside[static_cast<std::size_t>(y)].edges += whole ? 1 : 0;
        }
    });
    for (int y = 0; y < height; ++y) {
        Beside near;
        for (int v = std::max(0, y - height / kRowsNear); v <= std::min(height - 1, y + height / kRowsNear); ++v) {
            near.pixels += beside[static_cast<std::size_t>(v)].pixels;
            near.edges += beside[static_cast<std::size_t>(v)].edges;
        }
        edges_beside_[static_cast<std::size_t>(y)] = static_cast<double>(near.edges) / std::max(1, near.pixels);
    }
}

bool RevolutionRows::may_be_body(int x, int y) const {
    const int other = mirrored(x);
    const int from = std::max(0, std::min(x, other) + kOutline_px);
    const int to = std::min(edges_.width() - 1, std::max(x, other) + 1 - kOutline_px);
    const double edges_beside = edges_beside_[static_cast<std::size_t>(y)];
    if (from >= to || (to - from) * edges_beside < kFewestBeside) return true;
    const int resting = still_(to, y) - still_(from, y);
    return resting >= kStillOfRow * (to - from) &&
           edges_(to, y) - edges_(from, y) <= std::max<double>(kFewEdges, kEvenShare * edges_beside * resting);
}

}  // namespace rs::capture
