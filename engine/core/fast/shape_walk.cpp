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

#include "engine/core/fast/shown_surface_lanes.inl"

HWY_BEFORE_NAMESPACE();
namespace rs::engine::HWY_NAMESPACE {

// The pixels of as many rows of a column as a vector has. lambda: null where nobody needs it.
struct PixelRows {
    const ShapeColumn& column;
    const std::int32_t* rise_q24;
    std::int32_t* colour;
    std::int32_t* lambda;
};

HWY_INLINE void show_nothing(const PixelRows& rows) {
    hn::Store(hn::Zero(Lanes()), Lanes(), rows.colour);
    if (rows.lambda != nullptr) hn::Store(hn::Zero(Lanes()), Lanes(), rows.lambda);
}

// shape_pixel() of these rows, step by step.
class PixelLanes {
public:
    HWY_INLINE void begin(const ShapeWalk& walk, const ShapeColumn& column, Vector rise) {
        march_ = MarchLanes(walk, column, rise);
        looking_ = hn::Not(none());
    }

    // The next surface of the rows that look for one; false where none has any.
    HWY_INLINE bool meet(const ShapeColumn& column) {
        met_ = march_.next(looking_);
        if (column.alone) met_ = hn::IfThenElse(is_surface(met_), depth_of(met_), number(column.foot_depth_q3));
        looking_ = hn::And(looking_, is_surface(met_));
        return !hn::AllFalse(Lanes(), looking_);
    }

    HWY_INLINE void place(const ShapeWalk& walk, const ShapeColumn& column, Vector rise) {
        place_ = surface_place(walk, column, rise, column.alone ? met_ : depth_of(met_), looking_);
    }

    // The first surface. False where no row looks for another.
    HWY_INLINE bool show_first(const ShapeWalk& walk, const PixelRows& rows) {
        const ShownLanes surface = shown_lanes(walk, rows.column, place_, met_, looking_);
        const Vector colour = hn::IfThenElseZero(surface.shown, surface.colour);
        hn::Store(colour, Lanes(), rows.colour);
        if (rows.lambda != nullptr) {
            hn::Store(hn::IfThenZeroElse(hn::Eq(colour, hn::Zero(Lanes())), place_.lambda_q20), Lanes(), rows.lambda);
        }
        if (rows.column.alone) return false;
        uncovered_ = none();
        return look_further(surface);
    }

    // The others.
    HWY_INLINE void show_others(const ShapeWalk& walk, const PixelRows& rows) {
        const Vector zero = hn::Zero(Lanes());
        const Vector rise = hn::LoadU(Lanes(), rows.rise_q24);
        const auto show = [&] {
            place(walk, rows.column, rise);
            return shown_lanes(walk, rows.column, place_, met_, looking_);
        };
        while (!hn::AllFalse(Lanes(), looking_) && meet(rows.column)) {
            const ShownLanes surface = show();
            add(rows, hn::And(surface.shown, hn::Ne(surface.colour, zero)), surface.colour, surface.shown);
            look_further(surface);
        }
        for (const Vector behind : {march_.behind(), march_.farthest()}) {
            met_ = behind;
            looking_ = hn::And(uncovered_, is_surface(met_));
            if (hn::AllFalse(Lanes(), looking_)) continue;
            const ShownLanes surface = show();
            const Vector nearer = hn::Load(Lanes(), rows.colour);
            const Vector farther = hn::IfThenElseZero(surface.shown, surface.colour);
            const LaneMask alone = hn::And(looking_, hn::Eq(nearer, zero));
            const LaneMask covers = hn::And(looking_, at_least(alpha_of(farther), number(kCoveringAlpha)));
            const LaneMask seen =
                hn::Or(hn::And(alone, hn::Ne(farther, zero)), hn::And(covers, hn::Lt(alpha_of(nearer), number(128))));
            add(rows, seen, hn::IfThenElse(alone, farther, laid_over(nearer, farther)), hn::Or(alone, covers));
            uncovered_ = hn::AndNot(covers, uncovered_);
        }
    }

private:
    // `colour` of the lanes `shown`, with this surface's depth of the lanes `seen`.
    HWY_INLINE void add(const PixelRows& rows, LaneMask seen, Vector colour, LaneMask shown) const {
        hn::Store(hn::IfThenElse(shown, colour, hn::Load(Lanes(), rows.colour)), Lanes(), rows.colour);
        if (rows.lambda == nullptr) return;
        hn::Store(hn::IfThenElse(seen, place_.lambda_q20, hn::Load(Lanes(), rows.lambda)), Lanes(), rows.lambda);
    }

    // Which rows look for another surface, or for those behind the last.
    HWY_INLINE bool look_further(const ShownLanes& surface) {
        const LaneMask covers = hn::And(surface.shown, at_least(alpha_of(surface.colour), number(kCoveringAlpha)));
        const LaneMask at_end = hn::And(hn::AndNot(covers, looking_), march_.ended());
        if (!hn::AllFalse(Lanes(), at_end)) {
            const LaneMask has_more = hn::Or(is_surface(march_.behind()), is_surface(march_.farthest()));
            uncovered_ = hn::Or(uncovered_, hn::And(at_end, has_more));
        }
        looking_ = hn::AndNot(march_.ended(), hn::AndNot(surface.shown, looking_));
        return !hn::AllFalse(Lanes(), hn::Or(looking_, uncovered_));
    }

    MarchLanes march_;
    SurfacePlace place_;
    Vector met_;
    LaneMask looking_;
    LaneMask uncovered_;  // whose last surface does not cover the pixel, but has others behind it
};

// A function of its own, since few vectors come here: what it needs would take registers from all others.
HWY_NOINLINE void show_others(const ShapeWalk& walk, const PixelRows& rows, PixelLanes& pixels) {
    pixels.show_others(walk, rows);
}

// shape_pixel() of as many rows of the columns as a vector has. Column after column would be one long chain of numbers
// that wait for each other; step after step, the columns overlap.
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
        if (pixels[n].meet(strip.columns[n])) {
            shown[shown_count++] = n;
        } else {
            show_nothing(rows_of(n));
        }
    }
    for (int s = 0; s < shown_count; ++s) pixels[shown[s]].place(walk, strip.columns[shown[s]], rise);
    for (int s = 0; s < shown_count; ++s) {
        const PixelRows rows = rows_of(shown[s]);
        PixelLanes& of_column = pixels[shown[s]];
        if (of_column.show_first(walk, rows)) show_others(walk, rows, of_column);
    }
}

bool can_walk() {
    return true;
}

// Four rows of four columns at a time: to[row][column] of of[column][row].
HWY_INLINE void turn_block(const std::int32_t (&of)[kStripColumns][kBlockRows], std::int32_t* to, std::ptrdiff_t stride,
                           int rows) {
    const hn::FixedTag<std::int32_t, 4> four;
    const hn::FixedTag<std::int64_t, 2> two;
    for (int row = 0; row < rows; row += 4) {
        for (int column = 0; column < kStripColumns; column += 4) {
            const auto from = [&](int n) { return hn::Load(four, of[column + n] + row); };
            const auto low = [&](auto a, auto b) { return hn::BitCast(two, hn::InterleaveLower(four, a, b)); };
            const auto high = [&](auto a, auto b) { return hn::BitCast(two, hn::InterleaveUpper(four, a, b)); };
            const auto low_01 = low(from(0), from(1));
            const auto low_23 = low(from(2), from(3));
            const auto high_01 = high(from(0), from(1));
            const auto high_23 = high(from(2), from(3));
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

// Rows first_row .. first_row + rows - 1 of the strip, at most kBlockRows.
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
    turn_block(colours, colour, colour_stride, rows);
    if (lambda != nullptr) turn_block(lambdas, lambda, lambda_stride, rows);
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
        // The view's right edge.
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
