#include "encode/raymap/hidden_cells.hpp"

#include "encode/set/soft_coverage.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace rs::encode {
namespace {

constexpr int kEnoughOfNine = 7;  // pixels around a point that show something clearly in front of it

// Of the pixels that are at most one away from where the picture sees the point, for how many holds(column, row); none
// where it sees it outside of its frame.
template <class Holds>
int count_around(const WorkView& view, const glm::dvec2& place, double y, const Holds& holds) {
    const std::optional<SeenPoint> seen = view.see(place, y);
    if (!seen) return 0;
    int count = 0;
    for_each_around(view, seen->whole_column(), seen->whole_row(), 1,
                    [&](int c, int r) { count += holds(c, r) ? 1 : 0; });
    return count;
}

// Whether a picture shows its other layer where the point is, or a pixel away from there.
bool other_layer_hides(const DepthView& picture, const glm::dvec2& place, double y) {
    const auto is_others = [&](int column, int row) {
        return std::isnan(picture.depth(row, column)) && picture.view.at(column, row).a >= kFaintest;
    };
    return count_around(picture.view, place, y, is_others) > 0;
}

// Whether what a picture was found to show stands clearly in front of the point.
bool is_hidden(const DepthView& picture, const glm::dvec2& place, double y) {
    const double nearer = picture.view.ray_of(picture.view.see(place).column).depth_of(place) - kClearlyInFront;
    const auto is_in_front = [&](int column, int row) {
        return static_cast<double>(picture.depth(row, column)) <= nearer;  // false where there is none
    };
    return count_around(picture.view, place, y, is_in_front) >= kEnoughOfNine;
}

}  // namespace

void avoid_hidden(const LineGrid& grid, const LinePictures& pictures, int p_cell, ShapeCell* cells) {
    const CellRay ray(grid, pictures.viewpoint, p_cell);
    for (int h = 0; h < grid.bands; ++h) {
        ShapeCell& cell = cells[h];
        if (!cell.has_surface()) continue;
        const auto both_show = [&](int d) {
            const glm::dvec2 place = ray.place(d);
            const double y = ray.height(h, d);
            return !other_layer_hides(pictures.first, place, y) && !other_layer_hides(pictures.second, place, y);
        };
        const std::optional<std::uint8_t> depth = nearest_depth(cell.depth, both_show);
        if (!depth) {
            cell = {};
            continue;
        }
        cell.depth = *depth;
    }
}

void say_who_shows(const LineGrid& grid, const LinePictures& pictures, bool trust_depths, int p_cell,
                   ShapeCell* cells) {
    constexpr int kBoth = ShapeCell::kByBoth;
    const CellRay ray(grid, pictures.viewpoint, p_cell);
    for (int h = 0; h < grid.bands; ++h) {
        ShapeCell& cell = cells[h];
        if (!cell.has_surface()) continue;
        const glm::dvec2 place = ray.place(cell.depth);
        const double y = ray.height(h, cell.depth);
        int shown = kBoth;
        if (trust_depths && is_hidden(pictures.first, place, y)) shown -= ShapeCell::kByFirst;
        if (trust_depths && is_hidden(pictures.second, place, y)) shown -= ShapeCell::kBySecond;
        // Where both are hidden some other picture's depth is wrong.
        cell.shown = static_cast<std::uint8_t>(shown == 0 ? kBoth : shown);
    }
}

}  // namespace rs::encode
