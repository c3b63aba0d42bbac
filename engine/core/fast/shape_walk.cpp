#include "engine/core/fast/shape_walk.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/core/fast/shape_walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

#if HWY_TARGET == HWY_SCALAR

HWY_BEFORE_NAMESPACE();
namespace rs::engine::HWY_NAMESPACE {

bool can_walk() {
    return false;
}

void walk_block(const ShapeWalk&, const ShapeStrip&, const std::int32_t*, int, int, std::int32_t*, std::ptrdiff_t,
                std::int32_t*, std::ptrdiff_t) {}

}  // namespace rs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#else

#include "engine/core/fast/blend_surface_lanes.inl"

HWY_BEFORE_NAMESPACE();
namespace rs::engine::HWY_NAMESPACE {

// Destination of one vector of rows of a column. lambda: null if depth is not requested.
struct PixelRows {
    const ShapeColumn& column;
    const std::int32_t* rise_q24;
    std::int32_t* colour;
    std::int32_t* lambda;
};

HWY_INLINE void clear_pixels(const PixelRows& rows) {
    hn::Store(hn::Zero(Lanes()), Lanes(), rows.colour);
    if (rows.lambda != nullptr) hn::Store(hn::Zero(Lanes()), Lanes(), rows.lambda);
}

// shape_pixel() of one vector of rows, split into steps.
class PixelLanes {
public:
    HWY_INLINE void begin(const ShapeWalk& walk, const ShapeColumn& column, Vector rise) {
        march_ = MarchLanes(walk, column, rise);
        active_ = hn::Not(none());
    }

    // Finds the next surface of the active rows; returns false if there is none in any row.
    HWY_INLINE bool find_surface(const ShapeColumn& column) {
        surface_ = march_.next(active_);
        if (column.alone)
            surface_ = hn::IfThenElse(is_surface(surface_), depth_of(surface_), number(column.foot_depth_q3));
        active_ = hn::And(active_, is_surface(surface_));
        return !hn::AllFalse(Lanes(), active_);
    }

    // Projects the surface into both images.
    HWY_INLINE void project(const ShapeWalk& walk, const ShapeColumn& column, Vector rise) {
        positions_ = surface_positions(walk, column, rise, column.alone ? surface_ : depth_of(surface_), active_);
    }

    // Writes the first surface; returns false if no row needs another one.
    HWY_INLINE bool write_first(const ShapeWalk& walk, const PixelRows& rows) {
        const BlendedLanes surface = blend_surface_lanes(walk, rows.column, positions_, surface_, active_);
        const Vector colour = hn::IfThenElseZero(surface.shown, surface.colour);
        hn::Store(colour, Lanes(), rows.colour);
        if (rows.lambda != nullptr) {
            hn::Store(hn::IfThenZeroElse(hn::Eq(colour, hn::Zero(Lanes())), positions_.lambda_q20), Lanes(),
                      rows.lambda);
        }
        if (rows.column.alone) return false;
        uncovered_ = none();
        return update_active(surface);
    }

    // Writes and blends all further surfaces.
    HWY_INLINE void blend_others(const ShapeWalk& walk, const PixelRows& rows) {
        const Vector zero = hn::Zero(Lanes());
        const Vector rise = hn::LoadU(Lanes(), rows.rise_q24);
        const auto blend = [&] {
            project(walk, rows.column, rise);
            return blend_surface_lanes(walk, rows.column, positions_, surface_, active_);
        };
        while (!hn::AllFalse(Lanes(), active_) && find_surface(rows.column)) {
            const BlendedLanes surface = blend();
            add(rows, hn::And(surface.shown, hn::Ne(surface.colour, zero)), surface.colour, surface.shown);
            update_active(surface);
        }
        for (const Vector behind : {march_.behind(), march_.farthest()}) {
            surface_ = behind;
            active_ = hn::And(uncovered_, is_surface(surface_));
            if (hn::AllFalse(Lanes(), active_)) continue;
            const BlendedLanes surface = blend();
            const Vector nearer = hn::Load(Lanes(), rows.colour);
            const Vector farther = hn::IfThenElseZero(surface.shown, surface.colour);
            const LaneMask alone = hn::And(active_, hn::Eq(nearer, zero));
            const LaneMask covers = hn::And(active_, at_least(alpha_of(farther), number(kCoveringAlpha)));
            const LaneMask seen =
                hn::Or(hn::And(alone, hn::Ne(farther, zero)), hn::And(covers, hn::Lt(alpha_of(nearer), number(128))));
            add(rows, seen, hn::IfThenElse(alone, farther, laid_over(nearer, farther)), hn::Or(alone, covers));
            uncovered_ = hn::AndNot(covers, uncovered_);
        }
    }

private:
    // Writes `colour` to the lanes `shown` and the depth of the surface to the lanes `seen`.
    HWY_INLINE void add(const PixelRows& rows, LaneMask seen, Vector colour, LaneMask shown) const {
        hn::Store(hn::IfThenElse(shown, colour, hn::Load(Lanes(), rows.colour)), Lanes(), rows.colour);
        if (rows.lambda == nullptr) return;
        hn::Store(hn::IfThenElse(seen, positions_.lambda_q20, hn::Load(Lanes(), rows.lambda)), Lanes(), rows.lambda);
    }

    // Deactivates the rows that are complete; returns true if any row needs another surface.
    HWY_INLINE bool update_active(const BlendedLanes& surface) {
        const LaneMask covers = hn::And(surface.shown, at_least(alpha_of(surface.colour), number(kCoveringAlpha)));
        const LaneMask at_end = hn::And(hn::AndNot(covers, active_), march_.ended());
        if (!hn::AllFalse(Lanes(), at_end)) {
            const LaneMask has_more = hn::Or(is_surface(march_.behind()), is_surface(march_.farthest()));
            uncovered_ = hn::Or(uncovered_, hn::And(at_end, has_more));
        }
        active_ = hn::AndNot(march_.ended(), hn::AndNot(surface.shown, active_));
        return !hn::AllFalse(Lanes(), hn::Or(active_, uncovered_));
    }

    MarchLanes march_;
    SurfacePositions positions_;
    Vector surface_;
    LaneMask active_;     // rows that need the next surface of the march
    LaneMask uncovered_;  // rows whose last surface does not cover the pixel and has others behind it
};

// Not inlined: few vectors need it, and inlining would cost registers in the common path.
HWY_NOINLINE void blend_others(const ShapeWalk& walk, const PixelRows& rows, PixelLanes& pixels) {
    pixels.blend_others(walk, rows);
}

// shape_pixel() of one vector of rows of each column. The columns are processed step by step instead of one after the
// other, so that their dependency chains overlap.
HWY_INLINE void walk_lanes(const ShapeWalk& walk, const ShapeStrip& strip, const int* columns, int count,
                           const std::int32_t* rise_q24, std::int32_t* colour, std::int32_t* lambda) {
    const Vector rise = hn::LoadU(Lanes(), rise_q24);
    PixelLanes pixels[kStripColumns];
    int shown[kStripColumns];
    int shown_count = 0;
    const auto rows_of = [&](int n) {
        std::int32_t* const lambdas = lambda == nullptr ? nullptr : lambda + n * kBlockRows;
        return PixelRows{strip.columns[n], rise_q24, colour + n * kBlockRows, lambdas};
    };
    for (int c = 0; c < count; ++c) pixels[columns[c]].begin(walk, strip.columns[columns[c]], rise);
    for (int c = 0; c < count; ++c) {
        const int n = columns[c];
        if (pixels[n].find_surface(strip.columns[n])) {
            shown[shown_count++] = n;
        } else {
            clear_pixels(rows_of(n));
        }
    }
    for (int s = 0; s < shown_count; ++s) pixels[shown[s]].project(walk, strip.columns[shown[s]], rise);
    for (int s = 0; s < shown_count; ++s) {
        const PixelRows rows = rows_of(shown[s]);
        PixelLanes& column_pixels = pixels[shown[s]];
        if (column_pixels.write_first(walk, rows)) blend_others(walk, rows, column_pixels);
    }
}

bool can_walk() {
    return true;
}

// Transposes a block, 4x4 at a time: to[row][column] = from[column][row].
HWY_INLINE void transpose_block(const std::int32_t (&from)[kStripColumns][kBlockRows], std::int32_t* to,
                                std::ptrdiff_t stride, int rows) {
    const hn::FixedTag<std::int32_t, 4> four;
    const hn::FixedTag<std::int64_t, 2> two;
    for (int row = 0; row < rows; row += 4) {
        for (int column = 0; column < kStripColumns; column += 4) {
            const auto load = [&](int n) { return hn::Load(four, from[column + n] + row); };
            const auto low = [&](auto a, auto b) { return hn::BitCast(two, hn::InterleaveLower(four, a, b)); };
            const auto high = [&](auto a, auto b) { return hn::BitCast(two, hn::InterleaveUpper(four, a, b)); };
            const auto low_01 = low(load(0), load(1));
            const auto low_23 = low(load(2), load(3));
            const auto high_01 = high(load(0), load(1));
            const auto high_23 = high(load(2), load(3));
            const auto store = [&](int n, auto v) {
                if (row + n < rows) hn::StoreU(hn::BitCast(four, v), four, to + (row + n) * stride + column);
            };
            store(0, hn::InterleaveLower(two, low_01, low_23));
            store(1, hn::InterleaveUpper(two, low_01, low_23));
            store(2, hn::InterleaveLower(two, high_01, high_23));
            store(3, hn::InterleaveUpper(two, high_01, high_23));
        }
    }
}

// Renders rows first_row .. first_row + rows - 1 of the strip, at most kBlockRows.
void walk_block(const ShapeWalk& walk, const ShapeStrip& strip, const std::int32_t* rise_q24, int first_row, int rows,
                std::int32_t* colour, std::ptrdiff_t colour_stride, std::int32_t* lambda,
                std::ptrdiff_t lambda_stride) {
    alignas(64) std::int32_t colours[kStripColumns][kBlockRows];
    alignas(64) std::int32_t lambdas[kStripColumns][kBlockRows];
    bool empty = true;
    for (int row = 0; row < kBlockRows; row += kLanes) {
        const int at = first_row + row;
        int walked[kStripColumns];
        int count = 0;
        for (int n = 0; n < kStripColumns; ++n) {
            if (at < strip.columns[n].end_row && at + kLanes > strip.columns[n].first_row) {
                walked[count++] = n;
                continue;
            }
            hn::Store(hn::Zero(Lanes()), Lanes(), colours[n] + row);
            hn::Store(hn::Zero(Lanes()), Lanes(), lambdas[n] + row);
        }
        if (count == 0) continue;
        empty = false;
        walk_lanes(walk, strip, walked, count, rise_q24 + at, colours[0] + row,
                   lambda == nullptr ? nullptr : lambdas[0] + row);
    }
    if (empty) {
        const hn::CappedTag<std::int32_t, kStripColumns> columns;
        const auto clear = [&](std::int32_t* to) {
            for (std::size_t n = 0; n < kStripColumns; n += hn::Lanes(columns)) {
                hn::StoreU(hn::Zero(columns), columns, to + n);
            }
        };
        for (int row = 0; row < rows; ++row) clear(colour + row * colour_stride);
        for (int row = 0; row < rows && lambda != nullptr; ++row) clear(lambda + row * lambda_stride);
        return;
    }
    transpose_block(colours, colour, colour_stride, rows);
    if (lambda != nullptr) transpose_block(lambdas, lambda, lambda_stride, rows);
}

}  // namespace rs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

#if HWY_ONCE
namespace rs::engine {

HWY_EXPORT(can_walk);
HWY_EXPORT(walk_block);

bool can_walk_shape() {
    return HWY_DYNAMIC_DISPATCH(can_walk)();
}

void walk_shape(const ShapeWalk& walk, const ShapeStrip& strip, const std::int32_t* rise_q24, int columns,
                const ShapeWalkOutput& out) {
    static_assert(sizeof(Rgba8) == sizeof(std::int32_t));
    const auto width = static_cast<std::size_t>(columns);
    for (int row = 0; row < walk.rows; row += kBlockRows) {
        const int rows = std::min(kBlockRows, walk.rows - row);
        Rgba8* const colour = out.colour + row * out.colour_stride;
        std::int32_t* const lambda = out.lambda_q20 == nullptr ? nullptr : out.lambda_q20 + row * out.lambda_stride;
        if (columns == kStripColumns) {
            HWY_DYNAMIC_DISPATCH(walk_block)
            (walk, strip, rise_q24, row, rows, reinterpret_cast<std::int32_t*>(colour), out.colour_stride, lambda,
             out.lambda_stride);
            continue;
        }
        // Right edge of the view: renders into buffers and copies the columns.
        std::int32_t colours[kBlockRows * kStripColumns];
        std::int32_t lambdas[kBlockRows * kStripColumns];
        HWY_DYNAMIC_DISPATCH(walk_block)
        (walk, strip, rise_q24, row, rows, colours, kStripColumns, lambdas, kStripColumns);
        for (int j = 0; j < rows; ++j) {
            std::memcpy(static_cast<void*>(colour + j * out.colour_stride), colours + j * kStripColumns,
                        width * sizeof(Rgba8));
            if (lambda != nullptr) std::copy_n(lambdas + j * kStripColumns, width, lambda + j * out.lambda_stride);
        }
    }
}

}  // namespace rs::engine
#endif  // HWY_ONCE
