// Measurements of placed_object.hpp that depend on the captured images alone.

#include "compositor/viewer/residency/placed_object.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace rs::compositor {
namespace {

constexpr std::uint8_t kSolid = 128;  // alpha of object pixels; lower values are the soft edge

struct RowRange {
    int begin = 0;
    int end = 0;  // begin == end: empty image
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

// Largest width of the rows in pixels, from the first to the last solid pixel.
int max_width(const Image<std::uint8_t>& alpha, RowRange rows) {
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

// CapturedView in floating point.
struct ImageScale {
    explicit ImageScale(const CapturedView& view)
        : axis_depth(std::ldexp(view.lines.front().l0_q20, -20)),  // x = 0 on every plane
          focal_px(std::ldexp(view.fl_y_q16, -16)),
          principal_row(std::ldexp(view.cy_q16, -16)),
          height(std::ldexp(view.height_q20, -20)) {}

    [[nodiscard]] double height_at(double row, double depth) const {
        return height + (principal_row - row) * depth / focal_px;
    }
    [[nodiscard]] double row_of(double at_height, double depth) const {
        return principal_row - (at_height - height) * focal_px / depth;
    }

    double axis_depth;
    double focal_px;
    double principal_row;
    double height;
};

// Measurements of one non-empty image.
struct SilhouetteMeasure {
    std::size_t view;
    RowRange rows;  // solid rows
    double azimuth_rad;
    double left;  // extent of the foot to either side of the axis, object radii
    double right;
};

// Azimuth of the camera about the axis: 0 at +Z, increasing towards +X.
double azimuth_of(const CapturedView& view) {
    const double step = 2 * kPi / static_cast<double>(view.lines.size());
    const double x =
        std::ldexp(view.lines[0].l1_q30, -30);  // dot product of forward and the tangents of planes 0 and 1
    const double along_next = std::ldexp(view.lines[1].l1_q30, -30);
    const double z = (x * std::cos(step) - along_next) / std::sin(step);
    return std::atan2(-x, -z);
}

// Silhouette measurements of the ring whose elevation is closest to horizontal, which shows the foot from the side.
std::vector<SilhouetteMeasure> silhouettes_of_lowest_ring(const RaySpaceObject& object) {
    const auto lowest = std::min_element(object.rings.begin(), object.rings.end(), [](const Ring& a, const Ring& b) {
        if (a.rotation.is_identity() != b.rotation.is_identity()) return a.rotation.is_identity();
        return std::abs(a.elevation_udeg) < std::abs(b.elevation_udeg);
    });
    std::vector<SilhouetteMeasure> silhouettes;
    for (const std::uint16_t view : lowest->views) {
        if (object.images[view].empty()) continue;
        const RowRange rows = occupied_rows(object.images[view].a, kSolid);
        if (rows.begin < rows.end) silhouettes.push_back({view, rows, azimuth_of(object.views[view]), 0, 0});
    }
    return silhouettes;
}

// Measures the object's extent to either side at the image rows of this foot height and below.
void measure_sides(const RaySpaceObject& object, double foot, SilhouetteMeasure& silhouette) {
    const Image<std::uint8_t>& alpha = object.images[silhouette.view].a;
    const CapturedView& view = object.views[silhouette.view];
    const ImageScale scale(view);
    const double axis_column = std::ldexp(view.cx_q16, -16) + std::ldexp(view.lines[0].q0_q16, -16) / scale.axis_depth;
    const int some = std::max((silhouette.rows.end - silhouette.rows.begin) / 24, 1);
    const auto begin = static_cast<int>(std::clamp(scale.row_of(foot, scale.axis_depth) - some,
                                                   static_cast<double>(silhouette.rows.begin),
                                                   static_cast<double>(silhouette.rows.end - some)));
    double first = axis_column;
    double last = axis_column;
    for (int y = begin; y < silhouette.rows.end; ++y) {
        for (int x = 0; x < alpha.width(); ++x) {
            if (alpha(x, y) < kSolid) continue;
            first = std::min(first, static_cast<double>(x));
            last = std::max(last, x + 1.0);
        }
    }
    silhouette.left = std::min((axis_column - first) * scale.axis_depth / scale.focal_px, 1.0);
    silhouette.right = std::min((last - axis_column) * scale.axis_depth / scale.focal_px, 1.0);
}

// Extent of the foot towards the camera of a silhouette: measured in the silhouettes a quarter turn to either side;
// half its own width without such.
double reach_towards(const std::vector<SilhouetteMeasure>& silhouettes, const SilhouetteMeasure& silhouette) {
    constexpr double kNearlyAQuarter_rad = kPi / 12;
    double sum = 0;
    int count = 0;
    for (const double side : {-1.0, 1.0}) {
        const SilhouetteMeasure* nearest = nullptr;
        double nearest_error = kNearlyAQuarter_rad;
        for (const SilhouetteMeasure& other : silhouettes) {
            const double turn = other.azimuth_rad - silhouette.azimuth_rad - side * kPi / 2;
            const double error = std::abs(std::remainder(turn, 2 * kPi));
            if (error >= nearest_error) continue;
            nearest = &other;
            nearest_error = error;
        }
        if (nearest == nullptr) continue;
        sum += side < 0 ? nearest->right : nearest->left;
        ++count;
    }
    return count > 0 ? sum / count : (silhouette.left + silhouette.right) / 2;
}

// Refines the foot height from an initial value: the height determines the rows at which the foot's extent is measured,
// and the extent determines how far the lowest point of each image is in front of the axis.
double foot_of(const RaySpaceObject& object, double foot) {
    std::vector<SilhouetteMeasure> silhouettes = silhouettes_of_lowest_ring(object);
    if (silhouettes.empty()) return foot;
    for (int i = 0; i < 3; ++i) {
        for (SilhouetteMeasure& silhouette : silhouettes) measure_sides(object, foot, silhouette);
        std::vector<double> heights;
        for (const SilhouetteMeasure& silhouette : silhouettes) {
            const ImageScale scale(object.views[silhouette.view]);
            const bool beyond_horizon = silhouette.rows.end < scale.principal_row;
            const double reach = reach_towards(silhouettes, silhouette);
            heights.push_back(
                scale.height_at(silhouette.rows.end, scale.axis_depth + (beyond_horizon ? reach : -reach)));
        }
        foot = median(std::move(heights));
    }
    return foot;
}

}  // namespace

BoundingCylinder bounding_cylinder(const RaySpaceObject& object) {
    BoundingCylinder bound{0, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Ring& ring : object.rings) {
        const double x_half = std::ldexp(ring.x_half_q20, -20);
        bound.radius = std::max(bound.radius, x_half);
        for (const std::uint16_t index : ring.views) {
            const PlanarImage& image = object.images[index];
            if (image.empty()) continue;
            const RowRange rows = occupied_rows(image.a, 1);
            if (rows.begin == rows.end) continue;
            const ImageScale scale(object.views[index]);
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
    for (std::size_t i = 0; i < object.images.size(); ++i) {
        const Image<std::uint8_t>& alpha = object.images[i].a;
        if (object.images[i].empty()) continue;
        const RowRange rows = occupied_rows(alpha, kSolid);
        if (rows.begin == rows.end) continue;
        const ImageScale scale(object.views[i]);
        // The rim farthest from the horizon is the near one, or the far one if an end of the object lies beyond the
        // horizon (e.g. a foot above the camera).
        const auto height_of_end = [&](int row, RowRange end_rows, bool beyond_horizon) {
            const double radius_px = max_width(alpha, end_rows) / 2.0;
            const double radius = std::min(radius_px / scale.focal_px * scale.axis_depth, 1.0);
            return scale.height_at(row, scale.axis_depth + (beyond_horizon ? radius : -radius));
        };
        const int some = std::max((rows.end - rows.begin) / 16, 1);
        bottoms.push_back(height_of_end(rows.end, {rows.end - some, rows.end}, rows.end < scale.principal_row));
        tops.push_back(height_of_end(rows.begin, {rows.begin, rows.begin + some}, rows.begin > scale.principal_row));
    }
    if (bottoms.empty()) return {};
    const double foot = object.foot_q20 ? std::ldexp(*object.foot_q20, -20) : foot_of(object, median(bottoms));
    return {foot, median(tops)};
}

}  // namespace rs::compositor
