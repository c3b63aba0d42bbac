#pragma once
// Section 6 of engine/RECONSTRUCTION.md, "The surface between cells": interpolates the depth samples of a shape map.
// The surface is continuous between cells that lie on the same surface and has a step between cells that do not. Cells
// are interpolated first between the two lines beside a ray, which is the same for a whole column of an upright view,
// then between two cells along p and two along height.

#include "rayspace/api/types/shape_map.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace rs::engine {

// Lean (visibility weight) of a surface that both images show. 0: only the first image shows it; 16: only the second.
inline constexpr std::int32_t kBothShow = 8;

// Surface at a cell or interpolated between cells.
struct SurfaceCell {
    std::int32_t depth_q3 = -1;  // eighths of a depth step; -1: no surface
    std::int32_t lean = kBothShow;
    // Over all surrounding cells on both lines, including those of weight 0.
    std::int32_t deepest = -1;  // greatest depth, whole steps; -1 if no cell has a surface
    bool all_have_one = false;  // every cell has a surface

    [[nodiscard]] bool exists() const { return depth_q3 >= 0; }
    bool operator==(const SurfaceCell&) const = default;
};

// Surfaces that a ray may meet between cells, in this order.
struct SurfaceStack {
    SurfaceCell first;     // interpolated surface
    SurfaceCell behind;    // the farther of two surfaces, if `first` is the nearer one
    SurfaceCell farthest;  // at the depth of the deepest of the eight cells, if all have a surface
};

// Columns of cells around a ray and its position between them.
struct CellColumns {
    const ShapeCell* at[2][2] = {};  // [p][line], each `bands` long; null: no shape
    std::int32_t p_part = 0;         // weight of the second column along p, eighths: 0..7
    std::int32_t line_part = 0;      // weight of the second line, eighths: 0..7
};

// SurfaceCell::lean / 8 of a cell: 0 if only the first image shows it, 1 if both do, 2 if only the second.
inline int lean_of(ShapeCell cell) {
    return cell.shown == ShapeCell::kByFirst ? 0 : cell.shown == ShapeCell::kBySecond ? 2 : 1;
}

// Interpolates between a cell of either line; `part`: weight of the second line, eighths.
inline SurfaceCell between_lines(ShapeCell first, ShapeCell second, int part, int jump) {
    SurfaceCell cell;
    cell.all_have_one = first.has_surface() && second.has_surface();
    if (first.has_surface()) cell.deepest = first.depth;
    if (second.has_surface()) cell.deepest = std::max<std::int32_t>(cell.deepest, second.depth);
    const bool has_second = second.has_surface() && part > 0;
    if (!first.has_surface() && !has_second) return cell;
    const int apart = second.depth - first.depth;
    if (first.has_surface() && has_second && std::abs(apart) <= jump) {
        cell.depth_q3 = 8 * first.depth + part * apart;
        cell.lean = (8 - part) * lean_of(first) + part * lean_of(second);
    } else {
        const ShapeCell& nearest = !first.has_surface() || (has_second && part >= 4) ? second : first;
        cell.depth_q3 = 8 * nearest.depth;
        cell.lean = 8 * lean_of(nearest);
    }
    return cell;
}

// Bilinear interpolation at p_part and h_part eighths between cells[p][h]. If the cells lie on two surfaces, averages
// only the nearer or only the farther cells, whichever have more weight.
inline SurfaceStack surfaces_between(const SurfaceCell (&cells)[2][2], int p_part, int h_part, int jump) {
    int nearest = 1 << 12;
    int farthest = -1;
    int deepest = -1;
    bool all_have_one = true;
    for (const auto& column : cells) {
        for (const SurfaceCell& cell : column) {
            deepest = std::max(deepest, cell.deepest);
            all_have_one = all_have_one && cell.all_have_one;
            if (!cell.exists()) continue;
            nearest = std::min(nearest, cell.depth_q3);
            farthest = std::max(farthest, cell.depth_q3);
        }
    }
    const bool steps = farthest - nearest > 8 * jump;
    int weight[2] = {};  // [0]: nearer group, [1]: farther group
    int sum[2] = {};
    int lean[2] = {};
    for (int p = 0; p < 2; ++p) {
        for (int h = 0; h < 2; ++h) {
            const SurfaceCell& cell = cells[p][h];
            if (!cell.exists()) continue;
            const int group = steps && 2 * cell.depth_q3 > nearest + farthest ? 1 : 0;
            const int part = (p == 0 ? 8 - p_part : p_part) * (h == 0 ? 8 - h_part : h_part);
            weight[group] += part;
            sum[group] += part * cell.depth_q3;
            lean[group] += part * cell.lean;
        }
    }
    const auto mean = [&](int group) {
        SurfaceCell surface{.deepest = deepest, .all_have_one = all_have_one};
        if (weight[group] == 0) return surface;
        const auto of_group = [&](int total) { return (total + weight[group] / 2) / weight[group]; };
        surface.depth_q3 = of_group(sum[group]);
        surface.lean = of_group(lean[group]);
        return surface;
    };
    const SurfaceCell behind_all = all_have_one ? SurfaceCell{.depth_q3 = 8 * deepest} : SurfaceCell{};
    if (weight[0] < weight[1]) return {mean(1), {}, behind_all};
    return {mean(0), mean(1), behind_all};
}

}  // namespace rs::engine
