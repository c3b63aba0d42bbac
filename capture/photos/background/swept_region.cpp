#include "capture/photos/background/swept_region.hpp"

#include "capture/opencv/connected_parts.hpp"
#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/base/median.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kGridSide = 256;
constexpr float kMovingShare = 0.4F;  // of a cell's pixels

// What a contour costs per cell: where motion ends, along an edge, and through even ground.
constexpr float kMotionEnds = 0.5F;

constexpr float kEdge = 1;
constexpr float kEven = 20;
constexpr float kEdge_delta_e = 3.5F;

constexpr float kSure = 1e6F;

// Neighbouring cells of one surface differ by less than this.
constexpr float kOneSurface_delta_e = 4;
constexpr int kEdgeCells = 2;   // that an edge is wide
constexpr int kBandShare = 16;  // of the picture's height, that a still band may be tall
constexpr int kRimCells = 4;    // a still rim beside what moves is at most this wide

struct Cell {
    Lab colour;
    bool moves = false;
};

Image<Cell> cells_of(ConstImageView<Rgba8> still, ConstImageView<std::uint8_t> moves, int side_px) {
    Image<Cell> cells((still.width() + side_px - 1) / side_px, (still.height() + side_px - 1) / side_px);
    for (int v = 0; v < cells.height(); ++v) {
        for (int u = 0; u < cells.width(); ++u) {
            LinearRgb sum;
            float count = 0;
            float moving = 0;
            for (int y = v * side_px; y < std::min(still.height(), (v + 1) * side_px); ++y) {
                for (int x = u * side_px; x < std::min(still.width(), (u + 1) * side_px); ++x) {
                    const LinearRgb colour = linear_rgb(still(x, y));
                    sum.r += colour.r;
                    sum.g += colour.g;
                    sum.b += colour.b;
                    count += 1;
                    moving += moves(x, y) != 0 ? 1.0F : 0.0F;
                }
            }
            cells(u, v) = {lab_from_linear({sum.r / count, sum.g / count, sum.b / count}),
                           moving >= kMovingShare * count};
        }
    }
    return cells;
}

float cost_between(const Cell& a, const Cell& b) {
    if (a.moves || b.moves) return kMotionEnds;
    const float contrast = delta_e(a.colour, b.colour) / kEdge_delta_e;
    return kEdge + kEven * std::exp(-0.5F * contrast * contrast);
}

// Column of the turntable's axis: what turns sweeps as much to its left as to its right. Only the upper half is
// compared, for shadows fall to one side.
std::optional<double> axis_of(const cv::Mat1b& swept) {
    const cv::Rect box = box_of(swept);
    std::vector<double> middles;
    for (int v = box.y; v < box.y + std::max(1, box.height / 2); ++v) {
        int left = -1;
        int right = -1;
        for (int u = 0; u < swept.cols; ++u) {
            if (swept(v, u) == 0) continue;
            if (left < 0) left = u;
            right = u;
        }
        if (left >= 0) middles.push_back(0.5 * (left + right + 1));
    }
    if (middles.empty()) return std::nullopt;
    return median(std::move(middles));
}

// Where neighbouring cells differ, gaps closed.
cv::Mat1b edges_of(const Image<Cell>& cells) {
    cv::Mat1b edges(cells.height(), cells.width(), std::uint8_t{0});
    for (int v = 0; v < edges.rows; ++v) {
        for (int u = 0; u < edges.cols; ++u) {
            for (const auto& [s, t] : {std::pair{u + 1, v}, {u, v + 1}}) {
                if (s >= edges.cols || t >= edges.rows) continue;
                if (delta_e(cells(u, v).colour, cells(s, t).colour) < kOneSurface_delta_e) continue;
                edges(v, u) = edges(t, s) = 255;
            }
        }
    }
    cv::morphologyEx(edges, edges, cv::MORPH_CLOSE, cv::Mat());
    return edges;
}

// A part of a turning object that never changes is one of revolution, so in every row it lies evenly to both sides of
// the axis, within an edge: the lip of a vase above all that moves, and the rim of its belly. So does the disc, but
// that is much wider than what stands on it.
void add_parts_of_revolution(const Image<Cell>& cells, double axis, cv::Mat1b& swept) {
    const cv::Rect moving = box_of(swept);
    cv::Mat1b surfaces;
    cv::bitwise_not(edges_of(cells) | swept, surfaces);
    const ConnectedParts parts(surfaces, 4);
    const auto enclosed = [&](int u, int v) {
        const int label = parts.label(u, v);
        return label == 0 || !parts.touches_border(label);
    };
    // From the axis outwards; the shorter side counts.
    const int middle = std::clamp(static_cast<int>(axis), 0, swept.cols - 1);
    const auto reach = [&](auto holds, int v) {
        int wide = 0;
        while (middle - wide >= 0 && middle + wide < swept.cols && holds(middle - wide, v) && holds(middle + wide, v)) {
            ++wide;
        }
        return wide;
    };
    const cv::Mat1b before = swept.clone();
    bool lip = true;  // still part of what stands above the moving rows
    for (int v = moving.y + moving.height - 1; v >= 0 && lip; --v) {
        int wide = reach(enclosed, v);
        const int moves = reach([&](int u, int w) { return before(w, u) != 0; }, v);
        lip = v >= moving.y || wide > 0;
        const bool through =
            wide > middle || middle + wide >= swept.cols;  // an edge of the backdrop crosses the picture
        if (v < moving.y && (through || wide > moving.width)) continue;
        wide = v < moving.y ? wide : std::min(wide, moves + kRimCells);
        for (int u = middle - wide + 1; u < middle + wide; ++u) swept(v, u) = 255;
    }
    // A foot below all that moves, less than half as wide as the body: the camera looks down on it, so it is seen for
    // less than half of its width. What of this is the ground the plate will explain.
    const int bottom = moving.y + moving.height - 1;
    const int foot = reach([&](int u, int w) { return before(w, u) != 0; }, std::max(0, bottom - kEdgeCells));
    if (4 * foot > moving.width) return;
    const int end = std::min(swept.rows, bottom + 1 + foot / 2);
    for (int v = bottom + 1; v < end; ++v) {
        const double down = static_cast<double>(v - bottom) / (end - bottom);
        const int wide = static_cast<int>(foot * std::sqrt(1 - down * down));
        for (int u = std::max(0, middle - wide + 1); u < std::min(swept.cols, middle + wide); ++u) swept(v, u) = 255;
    }
}

// What turns sweeps a body of revolution, which has no notches: a band that never changes between two that do is the
// object's, and in every row so is what lies between the ends.
void close_bands(cv::Mat1b& swept) {
    const int tall = std::max(3, swept.rows / kBandShare) | 1;
    cv::Mat1b closed;
    cv::morphologyEx(swept, closed, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_RECT, {1, tall}), {-1, -1}, 1,
                     cv::BORDER_CONSTANT, cv::Scalar::all(0));
    swept |= closed;  // near the picture's border closing takes away
    for (int v = 0; v < swept.rows; ++v) {
        int left = 0;
        int right = swept.cols - 1;
        while (left < right && swept(v, left) == 0) ++left;
        while (right > left && swept(v, right) == 0) --right;
        for (int u = left; u <= right; ++u) swept(v, u) = left < right ? 255 : swept(v, u);
    }
}

}  // namespace

SweptRegion swept_region(ConstImageView<Rgba8> still, ConstImageView<std::uint8_t> moves) {
    RS_CHECK(still.width() == moves.width() && still.height() == moves.height());
    SweptRegion region{Image<std::uint8_t>(still.width(), still.height()), std::nullopt};
    if (region.mask.empty()) return region;
    const int side_px = (std::max(still.width(), still.height()) + kGridSide - 1) / kGridSide;
    const Image<Cell> cells = cells_of(still, moves, side_px);
    const int width = cells.width();
    const int height = cells.height();
    const int nodes = width * height;
    cv::detail::GCGraph<float> graph(static_cast<unsigned>(nodes) + 2, static_cast<unsigned>(nodes) * 8 + 2);
    for (int i = 0; i < nodes; ++i) {
        graph.addVtx();
        const int u = i % width;
        const int v = i / width;
        const bool border = u == 0 || v == 0 || u == width - 1 || v == height - 1;
        const bool moving = cells(u, v).moves;
        graph.addTermWeights(i, moving ? kSure : 0, border && !moving ? kSure : 0);
    }
    // GCGraph refuses to be without edges, as it would be of one cell.
    const int spare = graph.addVtx();
    graph.addEdges(spare, graph.addVtx(), 0, 0);
    constexpr float kDiagonal = 0.70710678F;
    for (int v = 0; v < height; ++v) {
        for (int u = 0; u < width; ++u) {
            const auto join = [&](int s, int t, float length) {
                if (s < 0 || s >= width || t >= height) return;
                const float cost = length * cost_between(cells(u, v), cells(s, t));
                graph.addEdges(v * width + u, t * width + s, cost, cost);
            };
            join(u + 1, v, 1);
            join(u, v + 1, 1);
            join(u + 1, v + 1, kDiagonal);
            join(u - 1, v + 1, kDiagonal);
        }
    }
    graph.maxFlow();
    cv::Mat1b swept(height, width);
    for (int i = 0; i < nodes; ++i) swept(i / width, i % width) = graph.inSourceSegment(i) ? 255 : 0;
    if (const std::optional<double> axis = axis_of(swept)) {
        add_parts_of_revolution(cells, *axis, swept);
        region.axis_px = *axis * side_px;
    }
    close_bands(swept);
    for (int y = 0; y < region.mask.height(); ++y) {
        for (int x = 0; x < region.mask.width(); ++x) region.mask(x, y) = swept(y / side_px, x / side_px);
    }
    return region;
}

}  // namespace rs::capture
