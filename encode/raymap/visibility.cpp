#include "encode/raymap/visibility.hpp"

#include "encode/set/soft_coverage.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace rs::encode {
namespace {

constexpr int kOccludedPixels = 7;        // of 3x3 around a point
constexpr double kDepthTolerance = 0.05;  // between two photos' depths of one point, object radii
constexpr int kMinTexture = 6;            // standard deviation of luma, codes

// The number of pixels, of the 3x3 around where the view sees a point, for which is_counted(column, row); 0 where the
// point is outside of the frame.
template <class IsCounted>
int count_around(const WorkView& view, const glm::dvec2& place, double y, const IsCounted& is_counted) {
    const std::optional<ProjectedPoint> seen = view.see(place, y);
    if (!seen) return 0;
    int count = 0;
    for_each_around(view, seen->whole_column(), seen->whole_row(), 1,
                    [&](int c, int r) { count += is_counted(c, r) ? 1 : 0; });
    return count;
}

// True if a pixel without depth in this layer covers the point or one of the pixels around it.
bool is_covered_by_foreground(const DepthView& photo, const glm::dvec2& place, double y) {
    const auto is_foreground = [&](int column, int row) {
        return std::isnan(photo.depth(row, column)) && photo.view.at(column, row).a >= kMinVisibleAlpha;
    };
    return count_around(photo.view, place, y, is_foreground) > 0;
}

bool is_occluded(const DepthView& photo, const glm::dvec2& place, double y) {
    if (photo.occluders.empty()) return false;
    const double limit = photo.view.ray_of(photo.view.see(place).column).depth_of(place) - kClearlyInFront;
    const auto is_in_front = [&](int column, int row) {
        return photo.occluders(row, column) != 0 && static_cast<double>(photo.depth(row, column)) <= limit;
    };
    return count_around(photo.view, place, y, is_in_front) >= kOccludedPixels;
}

// Left-right consistency: whether a photo's depth map holds this point.
bool is_confirmed_by(const DepthView& photo, const glm::dvec2& place, double y) {
    const std::optional<ProjectedPoint> seen = photo.view.see(place, y);
    if (!seen) return false;
    const double depth = photo.view.ray_of(seen->column).depth_of(place);
    const auto found = static_cast<double>(photo.depth(seen->whole_row(), seen->whole_column()));
    return std::abs(found - depth) <= kDepthTolerance;  // false where it has no depth
}

}  // namespace

Image<std::uint8_t> find_occluders(const DepthView& photo, const Image<std::uint8_t>& texture,
                                   std::span<const DepthView* const> neighbors) {
    const WorkView& view = photo.view;
    Image<std::uint8_t> occluders(photo.depth.width(), photo.depth.height());
    for (int column = 0; column < view.width; ++column) {
        const HorizontalRay ray = view.ray_of(column + 0.5);
        for (int row = 0; row < view.height; ++row) {
            const auto depth = static_cast<double>(photo.depth(row, column));
            if (std::isnan(depth) || texture(row, column) < kMinTexture) continue;
            const glm::dvec2 place = ray.place_at(depth);
            const double y = view.height_of(row + 0.5, ray.axial_at(depth));
            const bool is_confirmed = std::ranges::any_of(
                neighbors, [&](const DepthView* neighbor) { return is_confirmed_by(*neighbor, place, y); });
            occluders(row, column) = is_confirmed ? 1 : 0;
        }
    }
    return occluders;
}

void avoid_foreground(const LineGrid& grid, const ViewPair& photos, int p_cell, ShapeCell* cells) {
    const CellRay ray(grid, photos.viewpoint, p_cell);
    for (int h = 0; h < grid.bands; ++h) {
        ShapeCell& cell = cells[h];
        if (!cell.has_surface()) continue;
        const auto is_clear = [&](int d) {
            const glm::dvec2 place = ray.place(d);
            const double y = ray.height(h, d);
            return !is_covered_by_foreground(photos.first, place, y) &&
                   !is_covered_by_foreground(photos.second, place, y);
        };
        const std::optional<std::uint8_t> depth = nearest_depth(cell.depth, is_clear);
        if (!depth) {
            cell = {};
            continue;
        }
        cell.depth = *depth;
    }
}

void classify_visibility(const LineGrid& grid, const ViewPair& photos, int p_cell, ShapeCell* cells) {
    const CellRay ray(grid, photos.viewpoint, p_cell);
    for (int h = 0; h < grid.bands; ++h) {
        ShapeCell& cell = cells[h];
        if (!cell.has_surface()) continue;
        const glm::dvec2 place = ray.place(cell.depth);
        const double y = ray.height(h, cell.depth);
        const bool in_first = !is_occluded(photos.first, place, y);
        const bool in_second = !is_occluded(photos.second, place, y);
        if (in_first == in_second) {
            cell.shown = ShapeCell::kByBoth;
        } else {
            cell.shown = in_first ? ShapeCell::kByFirst : ShapeCell::kBySecond;
        }
    }
}

}  // namespace rs::encode
