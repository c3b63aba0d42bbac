#pragma once
// Section 6 of engine/RECONSTRUCTION.md, "The surface between cells": cells of a shape map are samples, and the surface
// between them is continuous where they lie on one, and steps where they do not. First between the two lines beside a
// ray, which serves a whole column of an upright view; then between two cells along p and two along height.

#include "rayspace/api/types/shape_map.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace rs::engine {

// How far the blend of two images leans: 0, the first alone; 16, the second alone.
inline constexpr std::int32_t kBothShow = 8;

// A surface beside or between cells.
struct SurfaceCell {
    std::int32_t depth_q3 = -1;  // eighths of a depth step; -1: there is none
    std::int32_t lean = kBothShow;
    // Of the cells around, on either line, whatever their weights.
    std::int32_t deepest = -1;  // greatest depth, whole steps; -1 where none has a surface
    bool all_have_one = false;

    [[nodiscard]] bool exists() const { return depth_q3 >= 0; }
    bool operator==(const SurfaceCell&) const = default;
};

// What a ray may meet between cells, one after the other: their surface; where they lie on two and that is the nearer
// one, the farther one; and, where all eight cells have a surface, one at the depth of the farthest.
struct SurfaceStack {
    SurfaceCell first;
    SurfaceCell behind;
    SurfaceCell farthest;
};

// The columns of cells around a ray and its place between them.
struct CellColumns {
    const ShapeCell* at[2][2] = {};  // [p][line], each `bands` long; null: there is no shape
    std::int32_t p_part = 0;         // of the second in p, eighths: 0..7
    std::int32_t line_part = 0;      // of the second line, likewise
};

// Of a cell: 0 where the first image alone shows it, 1 where both do, 2.
inline int lean_of(ShapeCell cell) {
    return cell.shown == ShapeCell::kByFirst ? 0 : cell.shown == ShapeCell::kBySecond ? 2 : 1;
}

// `part` of the second line, in eighths.
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

// cells[p][h] around a point at p_part and h_part eighths between them. Where they lie on one surface, its mean;
// elsewhere that of the nearer ones or of the farther ones, whichever have more weight.
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
    int weight[2] = {};  // of the nearer group, of the farther one
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
