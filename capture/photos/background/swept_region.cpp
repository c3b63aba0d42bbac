#include "capture/photos/background/clean_plate.hpp"

#include "capture/opencv/connected_components.hpp"
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

using SweptRegionParameters = BackgroundParameters::SweptRegion;

struct GridCell {
    Lab lab;  // of the mean linear light
    bool moves = false;
};

Image<GridCell> cells_of(ConstImageView<Rgba8> colour, ConstImageView<std::uint8_t> moves, int side_px,
                         float min_moving_share) {
    Image<GridCell> cells((colour.width() + side_px - 1) / side_px, (colour.height() + side_px - 1) / side_px);
    for (int v = 0; v < cells.height(); ++v) {
        for (int u = 0; u < cells.width(); ++u) {
            LinearRgb sum;
            float count = 0;
            float moving = 0;
            for (int y = v * side_px; y < std::min(colour.height(), (v + 1) * side_px); ++y) {
                for (int x = u * side_px; x < std::min(colour.width(), (u + 1) * side_px); ++x) {
                    const LinearRgb light = linear_rgb(colour(x, y));
                    sum.r += light.r;
                    sum.g += light.g;
                    sum.b += light.b;
                    count += 1;
                    moving += moves(x, y) != 0 ? 1.0F : 0.0F;
                }
            }
            cells(u, v) = {lab_from_linear({sum.r / count, sum.g / count, sum.b / count}),
                           moving >= min_moving_share * count};
        }
    }
    return cells;
}

// Cost of the contour between two neighbouring cells, per cell of its length.
float contour_cost(const GridCell& a, const GridCell& b, const SweptRegionParameters& parameters) {
    if (a.moves || b.moves) return parameters.motion_boundary_cost;
    const float contrast = delta_e(a.lab, b.lab) / parameters.edge_delta_e;
    return parameters.edge_cost + parameters.uniform_cost * std::exp(-0.5F * contrast * contrast);
}

// The cheapest region that contains the moving cells and none of the others at the border.
cv::Mat1b minimum_cut(const Image<GridCell>& cells, const SweptRegionParameters& parameters) {
    constexpr float kHardConstraint = 1e6F;
    constexpr float kDiagonalLength = 0.70710678F;
    const int width = cells.width();
    const int height = cells.height();
    const int nodes = width * height;
    cv::detail::GCGraph<float> graph(static_cast<unsigned>(nodes) + 2, static_cast<unsigned>(nodes) * 8 + 2);
    for (int i = 0; i < nodes; ++i) {
        graph.addVtx();
        const int u = i % width;
        const int v = i / width;
        const bool is_border = u == 0 || v == 0 || u == width - 1 || v == height - 1;
        const bool moves = cells(u, v).moves;
        graph.addTermWeights(i, moves ? kHardConstraint : 0, is_border && !moves ? kHardConstraint : 0);
    }
    // GCGraph needs at least one edge; a grid of one cell has none.
    const int spare = graph.addVtx();
    graph.addEdges(spare, graph.addVtx(), 0, 0);
    for (int v = 0; v < height; ++v) {
        for (int u = 0; u < width; ++u) {
            const auto connect = [&](int s, int t, float length) {
                if (s < 0 || s >= width || t >= height) return;
                const float cost = length * contour_cost(cells(u, v), cells(s, t), parameters);
                graph.addEdges(v * width + u, t * width + s, cost, cost);
            };
            connect(u + 1, v, 1);
            connect(u, v + 1, 1);
            connect(u + 1, v + 1, kDiagonalLength);
            connect(u - 1, v + 1, kDiagonalLength);
        }
    }
    graph.maxFlow();
    cv::Mat1b swept(height, width);
    for (int i = 0; i < nodes; ++i) swept(i / width, i % width) = graph.inSourceSegment(i) ? 255 : 0;
    return swept;
}

// Column of the turntable's axis: the swept region is symmetric about it. Uses the upper half only, since shadows
// extend the lower half to one side.
std::optional<double> axis_column(const cv::Mat1b& swept) {
    const cv::Rect box = bounding_box(swept);
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

// Cells that differ from a neighbour, gaps closed.
cv::Mat1b surface_edges(const Image<GridCell>& cells, float same_surface_delta_e) {
    cv::Mat1b edges(cells.height(), cells.width(), std::uint8_t{0});
    for (int v = 0; v < edges.rows; ++v) {
        for (int u = 0; u < edges.cols; ++u) {
            for (const auto& [s, t] : {std::pair{u + 1, v}, {u, v + 1}}) {
                if (s >= edges.cols || t >= edges.rows) continue;
                if (delta_e(cells(u, v).lab, cells(s, t).lab) < same_surface_delta_e) continue;
                edges(v, u) = edges(t, s) = 255;
            }
        }
    }
    cv::morphologyEx(edges, edges, cv::MORPH_CLOSE, cv::Mat());
    return edges;
}

// Cells from column `middle` outwards for which `holds(u, v)` on both sides.
template <class Holds>
int symmetric_half_width(const cv::Mat1b& swept, int middle, int v, Holds holds) {
    int half = 0;
    while (middle - half >= 0 && middle + half < swept.cols && holds(middle - half, v) && holds(middle + half, v)) {
        ++half;
    }
    return half;
}

// Adds static parts of the object that are surfaces of revolution: symmetric about the axis and enclosed by edges, such
// as the lip of a vase above all moving rows and the rim of its belly. The turntable's disc is one as well, but much
// wider than the object.
void add_surfaces_of_revolution(const Image<GridCell>& cells, int middle, const SweptRegionParameters& parameters,
                                cv::Mat1b& swept) {
    const cv::Rect moving = bounding_box(swept);
    cv::Mat1b surfaces;
    cv::bitwise_not(surface_edges(cells, parameters.same_surface_delta_e) | swept, surfaces);
    const ConnectedComponents parts(surfaces, 4);
    const auto is_enclosed = [&](int u, int v) {
        const int label = parts.label(u, v);
        return label == 0 || !parts.touches_border(label);
    };
    const cv::Mat1b before = swept.clone();
    bool connected = true;  // to the moving rows
    for (int v = moving.y + moving.height - 1; v >= 0 && connected; --v) {
        int half = symmetric_half_width(swept, middle, v, is_enclosed);
        const int moving_half =
            symmetric_half_width(swept, middle, v, [&](int u, int row) { return before(row, u) != 0; });
        connected = v >= moving.y || half > 0;
        const bool is_background_edge = half > middle || middle + half >= swept.cols;  // reaches the image border
        if (v < moving.y && (is_background_edge || half > moving.width)) continue;
        half = v < moving.y ? half : std::min(half, moving_half + parameters.max_rim_cells);
        for (int u = middle - half + 1; u < middle + half; ++u) swept(v, u) = 255;
    }
}

// Adds half an ellipse below the lowest moving row of a body that narrows there: the visible part of a round foot, seen
// from above, is at most half as high as wide. Background in it is recognised later, by comparison with the plate.
// `moving`: as the minimum cut gives it, with box `box`.
void add_foot(const cv::Mat1b& moving, const cv::Rect& box, int middle, const SweptRegionParameters& parameters,
              cv::Mat1b& swept) {
    const int bottom = box.y + box.height - 1;
    const int half = symmetric_half_width(swept, middle, std::max(0, bottom - parameters.edge_cells),
                                          [&](int u, int row) { return moving(row, u) != 0; });
    if (2 * half > parameters.max_foot_share * box.width) return;
    const int end = std::min(swept.rows, bottom + 1 + half / 2);
    for (int v = bottom + 1; v < end; ++v) {
        const double down = static_cast<double>(v - bottom) / (end - bottom);
        const int wide = static_cast<int>(half * std::sqrt(1 - down * down));
        for (int u = std::max(0, middle - wide + 1); u < std::min(swept.cols, middle + wide); ++u) swept(v, u) = 255;
    }
}

// Adds static bands between moving ones, and everything between the ends of every row: the region swept by a turning
// body has no notches.
void close_bands(double max_band_share, cv::Mat1b& swept) {
    const int height = std::max(3, static_cast<int>(max_band_share * swept.rows)) | 1;
    cv::Mat1b closed;
    cv::morphologyEx(swept, closed, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_RECT, {1, height}), {-1, -1},
                     1, cv::BORDER_CONSTANT, cv::Scalar::all(0));
    swept |= closed;  // closing removes cells near the image border
    for (int v = 0; v < swept.rows; ++v) {
        int left = 0;
        int right = swept.cols - 1;
        while (left < right && swept(v, left) == 0) ++left;
        while (right > left && swept(v, right) == 0) --right;
        for (int u = left; u <= right; ++u) swept(v, u) = left < right ? 255 : swept(v, u);
    }
}

}  // namespace

Image<std::uint8_t> swept_region(ConstImageView<Rgba8> colour, ConstImageView<std::uint8_t> moves,
                                 const BackgroundParameters::SweptRegion& parameters) {
    RS_CHECK(colour.width() == moves.width() && colour.height() == moves.height());
    Image<std::uint8_t> region(colour.width(), colour.height());
    if (region.empty()) return region;
    const int grid = parameters.max_grid_cells;
    const int side_px = (std::max(colour.width(), colour.height()) + grid - 1) / grid;
    const Image<GridCell> cells = cells_of(colour, moves, side_px, parameters.min_moving_share);
    cv::Mat1b swept = minimum_cut(cells, parameters);
    if (const std::optional<double> axis = axis_column(swept)) {
        const cv::Mat1b moving = swept.clone();
        const int middle = std::clamp(static_cast<int>(*axis), 0, swept.cols - 1);
        add_surfaces_of_revolution(cells, middle, parameters, swept);
        add_foot(moving, bounding_box(moving), middle, parameters, swept);
    }
    close_bands(parameters.max_band_share, swept);
    for (int y = 0; y < region.height(); ++y) {
        for (int x = 0; x < region.width(); ++x) region(x, y) = swept(y / side_px, x / side_px);
    }
    return region;
}

}  // namespace rs::capture
