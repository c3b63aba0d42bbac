#include "compositor/gpu/visible_area.hpp"

#include "compositor/gpu/shader/reconstruction_shader.hpp"
#include "engine/core/definition/cell_march.hpp"
#include "engine/core/definition/effective_depth.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace rs::compositor {
namespace {

using engine::multiply_shift;

constexpr int kTile = 16;  // px; rectangles begin and end at tiles of the block

// Pixels [begin, end).
struct PixelRange {
    int begin = 0;
    int end = 0;
    [[nodiscard]] bool empty() const { return begin >= end; }
};

// A set-up, and the texels that are needed of it.
struct ColumnSetup {
    SetupTexel head;
    SetupTexel view;
    SetupTexel around;
};

// Band coordinates (q12) at the foot of a ray, at the first and at the last depth: all that the shader looks up are
// between these. See CellMarch.
struct RayBands {
    std::int32_t foot = 0;
    std::int32_t first = 0;
    std::int32_t last = 0;
    [[nodiscard]] std::int32_t lowest() const { return std::min({foot, first, last}); }
    [[nodiscard]] std::int32_t highest() const { return std::max({foot, first, last}); }
};

// Effective depths of the first and the last depth.
struct DepthRange {
    explicit DepthRange(const ShapeMap& shape) {
        if (shape.empty()) return;
        const engine::EffectiveDepth depths(shape);
        first_q3 = depths.at(0);
        last_q3 = depths.at(engine::EffectiveDepth::kDepths - 1);
    }
    std::int32_t first_q3 = 0;
    std::int32_t last_q3 = 0;
};

RayBands bands_of_ray(const SetupTexel& head, const ShapeMap& shape, const DepthRange& depths, std::int32_t b_q20,
                      std::int32_t rise_q24) {
    const std::int32_t h_q16 = (b_q20 >> 4) + multiply_shift(head[1], rise_q24, 28);
    const std::int32_t slope_q20 = multiply_shift(rise_q24, head[2], 24);
    const std::int32_t reference_q20 = multiply_shift(h_q16 - (shape.reference_height_q20 >> 4), head[3], 16);
    const std::int32_t per_radius_q20 = multiply_shift(slope_q20 - reference_q20, shape.bands_per_unit_q12, 12);
    RayBands bands;
    bands.foot = multiply_shift(h_q16 - (shape.h_low_q20 >> 4), shape.bands_per_unit_q12, 16);
    const std::int32_t per_depth_q20 =
        std::clamp(multiply_shift(per_radius_q20, shape.depth_step_q24, 24), -engine::CellMarch::kMaxPerDepth_q20,
                   engine::CellMarch::kMaxPerDepth_q20);
    bands.first = bands.foot + ((depths.first_q3 * (per_depth_q20 >> 3)) >> 8);
    bands.last = bands.foot + ((depths.last_q3 * (per_depth_q20 >> 3)) >> 8);
    return bands;
}

// Band coordinates at which the cells around a ray have surfaces, with the interpolation to the next band.
struct SurfaceBands {
    std::int32_t lowest = 0;
    std::int32_t highest = 0;
    [[nodiscard]] bool meet(const RayBands& bands) const {
        return bands.highest() >= lowest && bands.lowest() <= highest;
    }
};

SurfaceBands surface_bands(const SetupTexel& around) {
    const std::int32_t first = around[3] & 0xFFFF;
    const std::int32_t last = (around[3] >> 16) & 0xFFFF;
    return {(first - 1) * 4096 + 2048, (last + 1) * 4096 + 2048};
}

// Rays along captured rays also show the depth of their foot.
bool needs_surface(const SetupTexel& head) {
    const int weight = (head[0] >> 2) & 511;
    return static_cast<SetupKind>(head[0] & 3) == SetupKind::kShape && weight > 0 && weight < 256;
}

// Rows of the column of an upright view that can show something.
class VisibleRows {
public:
    VisibleRows(const engine::ViewRegisters& registers, const ShapeMap& shape, const DepthRange& depths)
        : registers_(registers), shape_(shape), depths_(depths) {}

    [[nodiscard]] PixelRange of(const ColumnSetup& setup, int column) const {
        const auto kind = static_cast<SetupKind>(setup.head[0] & 3);
        const PixelRange all{0, registers_.height};
        if (kind == SetupKind::kNoRay) return {};
        if (kind == SetupKind::kPlane) return {setup.view[2], setup.view[3]};
        if (!needs_surface(setup.head)) return all;
        const auto bands_at = [&](int row) {
            return bands_of_ray(setup.head, shape_, depths_, registers_.b_q20, registers_.rise_q24(column, row));
        };
        const RayBands top = bands_at(0);
        const RayBands bottom = bands_at(registers_.height - 1);
        const bool falls = top.foot >= bottom.foot && top.first >= bottom.first && top.last >= bottom.last;
        const bool rises = top.foot <= bottom.foot && top.first <= bottom.first && top.last <= bottom.last;
        if (!falls && !rises) return all;
        const SurfaceBands surfaces = surface_bands(setup.around);
        const auto above = [&](int row) { return bands_at(row).lowest() > surfaces.highest; };
        const auto below = [&](int row) { return bands_at(row).highest() < surfaces.lowest; };
        // Rounded bands may be off by one step in a row next to the first or the last one.
        constexpr int kMargin = 2;
        const int begin = falls ? first_row_not(above) : first_row_not(below);
        const int end = falls ? first_row_that(below) : first_row_that(above);
        return {std::max(begin - kMargin, 0), std::min(end + kMargin, registers_.height)};
    }

private:
    // First row at which a predicate is true that becomes true once as rows increase.
    template <class Predicate>
    [[nodiscard]] int first_row_that(const Predicate& is_true) const {
        PixelRange rows{0, registers_.height};
        while (!rows.empty()) {
            const int middle = (rows.begin + rows.end) / 2;
            if (is_true(middle)) {
                rows.end = middle;
            } else {
                rows.begin = middle + 1;
            }
        }
        return rows.begin;
    }
    template <class Predicate>
    [[nodiscard]] int first_row_not(const Predicate& is_true) const {
        return first_row_that([&](int row) { return !is_true(row); });
    }

    const engine::ViewRegisters& registers_;
    const ShapeMap& shape_;
    DepthRange depths_;
};

// The set-up of a pixel of `block`, in its row of set-ups.
ColumnSetup setup_at(std::span<const SetupTexel> setups, int width, int setup_row, int column) {
    const auto across = static_cast<std::size_t>(width);
    const std::size_t head =
        static_cast<std::size_t>(setup_row) * kSetupTexels * across + static_cast<std::size_t>(column);
    return {setups[head], setups[head + across], setups[head + 2 * across]};
}

// A view with the set-ups of its rows from first_row on.
struct ViewOfSetups {
    std::span<const SetupTexel> setups;
    int first_row;
    const engine::ViewRegisters& registers;
    const ShapeMap& shape;
    DepthRange depths;

    [[nodiscard]] bool may_show(int column, int row) const {
        const ColumnSetup setup = setup_at(setups, registers.width, row - first_row, column);
        if (static_cast<SetupKind>(setup.head[0] & 3) == SetupKind::kNoRay) return false;
        if (!needs_surface(setup.head)) return true;
        return surface_bands(setup.around)
            .meet(bands_of_ray(setup.head, shape, depths, registers.b_q20, registers.rise_q24(column, row)));
    }

    // Rows of a tile of a tilted view: all or none.
    [[nodiscard]] PixelRange rows_of_tile(const PixelRange& columns, const PixelRange& rows) const {
        for (int row = rows.begin; row < rows.end; ++row) {
            for (int column = columns.begin; column < columns.end; ++column) {
                if (may_show(column, row)) return rows;
            }
        }
        return {};
    }

    // Rows of some columns of an upright view, within `rows`.
    [[nodiscard]] PixelRange rows_of_columns(const PixelRange& columns, const PixelRange& rows) const {
        const VisibleRows visible(registers, shape, depths);
        PixelRange all{rows.end, rows.begin};
        for (int column = columns.begin; column < columns.end; ++column) {
            const PixelRange shown = visible.of(setup_at(setups, registers.width, 0, column), column);
            if (shown.empty()) continue;
            all = {std::min(all.begin, shown.begin), std::max(all.end, shown.end)};
        }
        return {std::max(all.begin, rows.begin), std::min(all.end, rows.end)};
    }
};

// Adds a rectangle, joined to the last one if that ends where it begins and has the same rows.
void add(std::vector<PixelRect>& rectangles, const PixelRect& next) {
    if (!rectangles.empty()) {
        PixelRect& last = rectangles.back();
        if (last.left + last.width == next.left && last.top == next.top && last.height == next.height) {
            last.width += next.width;
            return;
        }
    }
    rectangles.push_back(next);
}

}  // namespace

std::vector<PixelRect> visible_rectangles(std::span<const SetupTexel> setups, int first_row,
                                          const engine::ViewRegisters& registers, const ShapeMap& shape,
                                          const PixelRect& block) {
    std::vector<PixelRect> rectangles;
    const ViewOfSetups view{setups, first_row, registers, shape, DepthRange(shape)};
    const bool upright = registers.upright();
    const int right = block.left + block.width;
    const int bottom = block.top + block.height;
    const int tile_height = upright ? block.height : kTile;
    for (int top = block.top; top < bottom; top += tile_height) {
        const PixelRange rows{top, std::min(top + tile_height, bottom)};
        for (int left = block.left; left < right; left += kTile) {
            const PixelRange columns{left, std::min(left + kTile, right)};
            const PixelRange shown = upright ? view.rows_of_columns(columns, rows) : view.rows_of_tile(columns, rows);
            if (shown.empty()) continue;
            add(rectangles, {left, shown.begin, columns.end - left, shown.end - shown.begin});
        }
    }
    return rectangles;
}

}  // namespace rs::compositor
