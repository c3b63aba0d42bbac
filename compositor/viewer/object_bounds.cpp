#include "compositor/viewer/object_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace rs::compositor {
namespace {

constexpr std::uint8_t kSolid = 128;  // alpha from which a pixel counts as the object rather than its fringe

struct RowRange {
    int begin = 0;
    int end = 0;  // begin == end: the picture is empty
};

RowRange occupied_rows(const Image<std::uint8_t>& alpha, std::uint8_t least) {
    const auto shows = [&](int y) {
        return std::any_of(alpha.row(y), alpha.row(y) + alpha.width(), [=](std::uint8_t a) { return a >= least; });
    };
    RowRange rows{0, alpha.height()};
    while (rows.begin < rows.end && !shows(rows.begin)) ++rows.begin;
    while (rows.begin < rows.end && !shows(rows.end - 1)) --rows.end;
    return rows;
}

// The widest of the rows, in pixels from its first solid one to its last.
int widest(const Image<std::uint8_t>& alpha, RowRange rows) {
    int width = 0;
    for (int y = rows.begin; y < rows.end; ++y) {
        int first = 0;
        int last = alpha.width() - 1;
        while (first <= last && alpha(first, y) < kSolid) ++first;
        while (first <= last && alpha(last, y) < kSolid) --last;
        width = std::max(width, last + 1 - first);
    }
    return width;
}

// A CapturedView in floating point.
struct PictureScale {
    explicit PictureScale(const CapturedView& view)
        : axis_depth(std::ldexp(view.lines.front().l0_q20, -20)),  // where x = 0, on every plane
          focal_px(std::ldexp(view.fl_y_q16, -16)),
          principal_row(std::ldexp(view.cy_q16, -16)),
          height(std::ldexp(view.height_q20, -20)) {}

    [[nodiscard]] double height_at(double row, double depth) const {
        return height + (principal_row - row) * depth / focal_px;
    }

    double axis_depth;
    double focal_px;
    double principal_row;
    double height;
};

}  // namespace

BoundingCylinder bounding_cylinder(const RaySpaceObject& object) {
    BoundingCylinder bound{0, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Ring& ring : object.rings) {
        const double x_half = std::ldexp(ring.x_half_q20, -20);
        bound.radius = std::max(bound.radius, x_half);
        for (const std::uint16_t index : ring.views) {
            const PlanarPicture& picture = object.pictures[index];
            if (picture.empty()) continue;
            const RowRange rows = occupied_rows(picture.a, 1);
            if (rows.begin == rows.end) continue;
            const PictureScale scale(object.views[index]);
            for (const double depth : {std::max(scale.axis_depth - x_half, 0.0), scale.axis_depth + x_half}) {
                bound.top = std::max(bound.top, scale.height_at(rows.begin, depth));
                bound.bottom = std::min(bound.bottom, scale.height_at(rows.end, depth));
            }
        }
    }
    if (bound.empty()) return {bound.radius, 0, 0};
    return bound;
}

UprightExtent estimated_extent(const RaySpaceObject& object) {
    std::vector<double> bottoms;
    std::vector<double> tops;
    for (std::size_t i = 0; i < object.pictures.size(); ++i) {
        const Image<std::uint8_t>& alpha = object.pictures[i].a;
        if (object.pictures[i].empty()) continue;
        const RowRange rows = occupied_rows(alpha, kSolid);
        if (rows.begin == rows.end) continue;
        const PictureScale scale(object.views[i]);
        // The rim that reaches farthest away from the horizon is the near one; where an end of the object lies beyond
        // the horizon (a foot above the camera) it is the far one.
        const auto height_of_end = [&](int row, RowRange end_rows, bool beyond_horizon) {
            const double radius_px = widest(alpha, end_rows) / 2.0;
            const double radius = std::min(radius_px / scale.focal_px * scale.axis_depth, 1.0);
            return scale.height_at(row, scale.axis_depth + (beyond_horizon ? radius : -radius));
        };
        const int some = std::max((rows.end - rows.begin) / 16, 1);
        bottoms.push_back(height_of_end(rows.end, {rows.end - some, rows.end}, rows.end < scale.principal_row));
        tops.push_back(height_of_end(rows.begin, {rows.begin, rows.begin + some}, rows.begin > scale.principal_row));
    }
    if (bottoms.empty()) return {};
    const auto median = [](std::vector<double>& values) {
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    };
    return {median(bottoms), median(tops)};
}

}  // namespace rs::compositor
