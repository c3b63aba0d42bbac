#include "encode/raymap/cost_volume.hpp"

#include <algorithm>
#include <cmath>

namespace rs::encode {
namespace {

constexpr double kFarthestRow = 32000;  // that 32 bits hold in 1/65536

// Rows [top, bottom) of one column at one depth against one neighbour.
void compare_column(const WorkView& view, const WorkView& neighbour, const HorizontalRay& ray, double depth, int column,
                    const ObjectBox& box, std::uint8_t* costs) {
    const int rows = box.height();
    std::fill(costs, costs + rows, kUnknownMatch);
    const double axial = ray.axial_at(depth);
    if (axial <= 0.05) return;
    const SeenColumn seen = neighbour.see(ray.place_at(depth));
    if (seen.axial <= 0.05) return;
    // Between two columns of the neighbour, in 1/32 px.
    const double left = seen.column - 0.5;
    const auto c0 = static_cast<int>(std::floor(left));
    if (c0 < -1 || c0 >= neighbour.width) return;
    // Rows are linear in rows.
    const double scale = (neighbour.fl_y / seen.axial) * (axial / view.fl_y);
    const double at_top = neighbour.row_of(view.height_of(box.top + 0.5, axial), seen.axial);
    const double at_bottom = at_top + scale * rows;
    if (!(std::abs(at_top) < kFarthestRow && std::abs(at_bottom) < kFarthestRow)) return;
    match_column({.own = view.columns.row(column) + box.top,
                  .first = neighbour.columns.row(std::max(c0, 0)),
                  .second = neighbour.columns.row(std::min(c0 + 1, neighbour.width - 1)),
                  .part = static_cast<int>((left - c0) * 32),
                  .rows = rows,
                  .height = neighbour.height,
                  .position_q16 = static_cast<std::int32_t>(std::lround(std::ldexp(at_top, 16))),
                  .step_q16 = static_cast<std::int32_t>(std::lround(std::ldexp(scale, 16)))},
                 costs);
}

}  // namespace

ObjectBox object_box(const WorkView& view) {
    ObjectBox box{view.width, view.height, 0, 0};
    for (int column = 0; column < view.width; ++column) {
        for (int row = 0; row < view.height; ++row) {
            if (view.at(column, row).a == 0) continue;
            box = {std::min(box.left, column), std::min(box.top, row), std::max(box.right, column + 1),
                   std::max(box.bottom, row + 1)};
        }
    }
    return box;
}

CostVolume matching_costs(const WorkView& view, const Neighbours& neighbours, const DepthRange& range) {
    CostVolume volume;
    volume.box = object_box(view);
    volume.levels = range.count;
    if (volume.box.empty()) return volume;
    const auto rows = static_cast<std::size_t>(volume.box.height());
    const auto levels = static_cast<std::size_t>(range.count);
    volume.costs.resize(static_cast<std::size_t>(volume.box.width()) * rows * levels);
    std::vector<const WorkView*> all = neighbours.beside;
    all.insert(all.end(), neighbours.across.begin(), neighbours.across.end());
    std::vector<std::uint8_t> costs(rows * all.size());
    std::vector<std::uint8_t> merged(rows);
    for (int column = volume.box.left; column < volume.box.right; ++column) {
        const HorizontalRay ray = view.ray_of(column + 0.5);
        std::uint8_t* const to = volume.at(column, volume.box.top);
        for (int level = 0; level < range.count; ++level) {
            for (std::size_t n = 0; n < all.size(); ++n) {
                compare_column(view, *all[n], ray, range.at(level), column, volume.box, costs.data() + n * rows);
            }
            merge_matches(costs.data(), static_cast<int>(rows), static_cast<int>(neighbours.beside.size()),
                          static_cast<int>(neighbours.across.size()), merged.data());
            for (std::size_t row = 0; row < rows; ++row) {
                to[row * levels + static_cast<std::size_t>(level)] = merged[row];
            }
        }
    }
    return volume;
}

void forbid_outside(CostVolume& volume, const WorkView& view, const SampledHull& hull, const DepthRange& range) {
    const ObjectBox& box = volume.box;
    for (int column = box.left; column < box.right; ++column) {
        const HorizontalRay ray = view.ray_of(column + 0.5);
        std::uint8_t* const costs = volume.at(column, box.top);
        for (int level = 0; level < range.count; ++level) {
            const double depth = range.at(level);
            const double axial = ray.axial_at(depth);
            const std::span<const Interval> heights = hull.heights_above(ray.place_at(depth));
            int row = box.top;
            const auto forbid_until = [&](int end) {
                for (; row < end; ++row) {
                    costs[static_cast<std::size_t>(row - box.top) * static_cast<std::size_t>(volume.levels) +
                          static_cast<std::size_t>(level)] = kOutsideCost;
                }
            };
            for (auto n = heights.rbegin(); n != heights.rend(); ++n) {
                const double top = std::clamp(view.row_of(n->high, axial), double(box.top), double(box.bottom));
                const double bottom = std::clamp(view.row_of(n->low, axial), double(box.top), double(box.bottom));
                forbid_until(static_cast<int>(std::ceil(top - 0.5)));
                row = std::max(row, static_cast<int>(std::ceil(bottom - 0.5)));
            }
            forbid_until(box.bottom);
        }
    }
}

}  // namespace rs::encode
