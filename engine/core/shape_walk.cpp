#include "engine/core/shape_walk.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/core/shape_walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/core/cell_march.hpp"
#include "engine/core/shape_pixel.hpp"

#include <algorithm>
#include <cstring>

#if HWY_TARGET == HWY_SCALAR

HWY_BEFORE_NAMESPACE();
namespace rs::engine::HWY_NAMESPACE {

bool can_walk() {
    return false;
}

void walk_shape_rows(const ShapeWalk&, const ShapeStrip&, const std::int32_t*, int, std::int32_t*, std::ptrdiff_t,
                     std::int32_t*, std::ptrdiff_t) {}

}  // namespace rs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#else

#include "engine/core/shape_lanes.inl"

HWY_BEFORE_NAMESPACE();
namespace rs::engine::HWY_NAMESPACE {

// ShapeCell, field by field.
struct CellLanes {
    Vector depth0;
    Vector depth1;
    Vector back;
    Vector rays;
};

HWY_INLINE LaneMask has_bits(Vector v, std::int32_t bits) {
    return hn::Ne(hn::And(v, number(bits)), hn::Zero(Lanes()));
}

HWY_INLINE LaneMask none() {
    return hn::Lt(hn::Zero(Lanes()), hn::Zero(Lanes()));
}

// 0 <= v < limit
HWY_INLINE LaneMask within(Vector v, Vector limit) {
    return hn::And(hn::Gt(limit, v), at_least(v, hn::Zero(Lanes())));
}

HWY_INLINE CellLanes choose(LaneMask mask, const CellLanes& yes, const CellLanes& no) {
    return {hn::IfThenElse(mask, yes.depth0, no.depth0), hn::IfThenElse(mask, yes.depth1, no.depth1),
            hn::IfThenElse(mask, yes.back, no.back), hn::IfThenElse(mask, yes.rays, no.rays)};
}

// CellMarch of shape_pixel.hpp for the lanes of one view row. Lanes march each at its own step until each has a cell.
class MarchLanes {
public:
    HWY_INLINE MarchLanes(const ShapeWalk& walk, const ShapeStrip& strip, int lane, Vector rise)
        : cells_(reinterpret_cast<const std::int32_t*>(walk.cells)),
          start_(hn::Load(Lanes(), strip.cell_start + lane)),
          bands_(hn::Load(Lanes(), strip.bands + lane)),
          beyond_(hn::Load(Lanes(), strip.beyond + lane)) {
        const Vector per_unit = number(walk.bands_per_unit_q12);
        const Vector h = hn::Add(number(walk.b_q16),
                                 multiply_shift_within<28>(hn::Load(Lanes(), strip.lambda_foot_q20 + lane), rise));
        const Vector slope = multiply_shift_within<24>(hn::Load(Lanes(), strip.inverse_r_q20 + lane), rise);
        const Vector reference = multiply_shift<16>(hn::Sub(h, number(walk.reference_height_q16)),
                                                    hn::Load(Lanes(), strip.inverse_rho_q20 + lane));
        const Vector per_radius = multiply_shift<12>(hn::Sub(slope, reference), per_unit);
        foot_ = hn::Sub(multiply_shift<16>(hn::Sub(h, number(walk.h_low_q16)), per_unit),
                        hn::ShiftLeft<12>(hn::Load(Lanes(), strip.low_band + lane)));
        zero_ = hn::Add(foot_, multiply_shift_within<28>(per_radius, number(walk.depth_low_q20)));
        per_depth_ = multiply_shift_within<24>(per_radius, number(walk.depth_step_q24));
        per_depth_ =
            hn::Min(hn::Max(per_depth_, number(-CellMarch::kMostPerDepth_q20)), number(CellMarch::kMostPerDepth_q20));
        const Vector steps =
            hn::Min(hn::Add(hn::ShiftRight<11>(hn::Abs(per_depth_)), number(1)), number(CellMarch::kMostSteps));
        const LaneMask one = hn::Eq(steps, number(1));
        begin_ = number(256);
        step_ = number(256);
        if (HWY_LIKELY(hn::AllTrue(Lanes(), one))) return;
        // Whole numbers by float division: the halves keep the quotients clear of them.
        const Floats floats;
        step_ = hn::ConvertTo(Lanes(), hn::Div(hn::Set(floats, 256.5F), hn::ConvertTo(floats, steps)));
        // The first step that reaches the nearest layer, (nearest - 1) / step; those before it can meet no cell.
        const auto before =
            hn::Sub(hn::ConvertTo(floats, hn::Load(Lanes(), strip.nearest + lane)), hn::Set(floats, 0.5F));
        const Vector first = hn::ConvertTo(Lanes(), hn::Div(before, hn::ConvertTo(floats, step_)));
        const Vector begin = hn::Mul(first, step_);
        // A ray that stays above or below all bands.
        const Vector from = band(begin);
        const Vector to = band(hn::Add(beyond_, step_));
        const LaneMask below = hn::Lt(hn::Max(from, to), hn::Zero(Lanes()));
        const LaneMask above = at_least(hn::Min(from, to), hn::ShiftLeft<12>(bands_));
        begin_ = hn::IfThenElse(hn::Or(one, hn::Or(below, above)), number(256), begin);
    }

    // Of the lanes `looking`; others get any cell.
    HWY_INLINE CellLanes next(LaneMask looking) {
        CellLanes found{hn::Zero(Lanes()), hn::Zero(Lanes()), hn::Zero(Lanes()), hn::Zero(Lanes())};
        const LaneMask ended = looking;
        LaneMask marching = hn::And(looking, hn::Lt(begin_, beyond_));
        while (!hn::AllFalse(Lanes(), marching)) {
            const Vector begin = begin_;
            const Vector end = hn::Add(begin, step_);
            CellLanes cell = cell_at(band(hn::Add(begin, hn::ShiftRight<1>(step_))), marching);
            const Vector nearest = hn::IfThenElse(has_bits(cell.rays, kFirstSeesLayer1 | kSecondSeesLayer1),
                                                  hn::Min(cell.depth0, cell.depth1), cell.depth0);
            const LaneMask hit = hn::And(hn::And(hn::Ne(cell.rays, hn::Zero(Lanes())), at_least(end, nearest)),
                                         hn::And(at_least(cell.back, begin), marching));
            cell.depth0 = hn::Max(cell.depth0, begin);
            cell.depth1 = hn::Max(cell.depth1, begin);
            found = choose(hit, cell, found);
            begin_ = hn::IfThenElse(marching, end, begin);
            marching = hn::AndNot(hit, hn::And(marching, hn::Lt(end, beyond_)));
        }
        const LaneMask last = hn::And(ended, hn::AndNot(ended_, hn::Eq(found.rays, hn::Zero(Lanes()))));
        if (hn::AllFalse(Lanes(), last)) return found;
        ended_ = hn::Or(ended_, last);
        CellLanes cell = cell_at(foot_, last);
        const Vector there_at = band(cell.depth0);
        const LaneMask elsewhere = hn::AndNot(hn::Eq(hn::ShiftRight<12>(there_at), hn::ShiftRight<12>(foot_)),
                                              hn::Ne(cell.rays, hn::Zero(Lanes())));
        if (!hn::AllFalse(Lanes(), elsewhere)) {
            const CellLanes there = cell_at(there_at, elsewhere);
            cell = choose(hn::Ne(there.rays, hn::Zero(Lanes())), there, cell);
        }
        return choose(last, cell, found);
    }

    // Lanes that have no cell left.
    [[nodiscard]] HWY_INLINE LaneMask ended() const { return ended_; }

private:
    HWY_INLINE Vector band(Vector d) const { return hn::Add(zero_, hn::ShiftRight<8>(hn::Mul(d, per_depth_))); }

    HWY_INLINE CellLanes cell_at(Vector at_q12, LaneMask wanted) const {
        const Vector band = hn::ShiftRight<12>(at_q12);
        const LaneMask exists = hn::And(wanted, within(band, bands_));
        const Vector index = hn::IfThenElseZero(exists, hn::Add(start_, band));
        const Vector cell = hn::IfThenElseZero(exists, hn::GatherIndex(Lanes(), cells_, index));
        const auto byte = [](Vector v) { return hn::And(v, number(255)); };
        return {byte(cell), byte(hn::ShiftRight<8>(cell)), byte(hn::ShiftRight<16>(cell)),
                byte(hn::ShiftRight<24>(cell))};
    }

    const std::int32_t* cells_;
    Vector start_;
    Vector bands_;
    Vector beyond_;
    Vector foot_;
    Vector zero_;
    Vector per_depth_;
    Vector step_;
    Vector begin_;
    LaneMask ended_ = none();
};

struct SampleLanes {
    LaneMask exists;
    Vector a;
    Channels sum;  // r, g, b; the fourth is a again
};

// sample_picture() of the lanes `wanted`.
HWY_INLINE SampleLanes sample_lanes(const ShapeWalk& walk, const ShapePictureLanes& picture, int lane, Vector d,
                                    Vector y_q16, LaneMask wanted) {
    const auto load = [&](const std::int32_t* lanes) { return hn::Load(Lanes(), lanes + lane); };
    const Vector l = hn::Add(load(picture.l0_q20), hn::ShiftRight<4>(hn::Mul(d, load(picture.l1_q24))));
    const Vector inverse_l = inverse(l);
    const Vector n = hn::Add(load(picture.n0_q12), hn::ShiftRight<2>(hn::Mul(d, load(picture.n1_q14))));
    const Vector column = hn::Add(load(picture.cx_q8), multiply_shift<24>(n, inverse_l));
    const Vector m = multiply_shift_within<16>(load(picture.fl_y_q8), inverse_l);
    const Vector row = hn::Sub(load(picture.cy_q8), multiply_shift<20>(m, hn::Sub(y_q16, load(picture.height_q16))));
    SampleLanes sample;
    sample.exists = hn::And(hn::And(wanted, at_least(l, number(kNearest_q20))),
                            hn::And(within(column, number(walk.width_q8)), within(row, number(walk.height_q8))));

    // The texels' border stands in for the clamps.
    const Vector x = hn::ShiftRight<5>(hn::Sub(column, number(128 - 16)));
    const Vector y = hn::ShiftRight<5>(hn::Sub(row, number(128 - 16)));
    const Vector fx = hn::And(x, number(7));
    const Vector fy = hn::And(y, number(7));
    const Vector index =
        hn::IfThenElseZero(sample.exists, hn::Add(hn::Add(load(picture.start), hn::ShiftRight<3>(y)),
                                                  hn::Mul(hn::ShiftRight<3>(x), number(walk.column_stride))));
    const auto bits = hn::BitCast(Wide(), index);
    const WideVector even = hn::ShiftLeft<2>(hn::And(bits, hn::Set(Wide(), 0xFFFFFFFF)));
    const WideVector odd = hn::ShiftLeft<2>(hn::ShiftRight<32>(bits));

    // Weights as pairs of 16 bits: of the upper texel and of the lower one.
    const Vector vertical = hn::Add(number(8), hn::Sub(hn::ShiftLeft<16>(fy), fy));
    const Vector of_right = multiply_halves(vertical, hn::Or(fx, hn::ShiftLeft<16>(fx)));
    const Vector of_left = hn::Sub(hn::ShiftLeft<3>(vertical), of_right);

    const auto* const texels = reinterpret_cast<const std::int32_t*>(walk.texels);
    const TexelPairs left = fetch(texels, even, odd);
    const TexelPairs right = fetch(texels + walk.column_stride, even, odd);
    const Vector left_alpha = weighted_alpha(left, of_left);
    const Vector right_alpha = weighted_alpha(right, of_right);
    sample.a = multiply_pairs(hn::Add(left_alpha, right_alpha), number(0x00010001));
    const Vector zero = hn::Zero(Lanes());
    sample.sum = {{zero, zero, zero, zero}};
    add_weighted(left, left_alpha, sample.sum);
    add_weighted(right, right_alpha, sample.sum);
    return sample;
}

struct LayerLanes {
    LaneMask exists;
    Vector score;
    Vector a;
    Channels sum;
    Vector lambda_q20;
};

// disagreement() of shape_pixel.hpp. 16320 = 64 * 255, and the float quotient by 255 keeps clear of whole numbers.
HWY_INLINE Vector disagreement_lanes(const SampleLanes& first, const SampleLanes& second) {
    Channels apart;
    for (int n = 0; n < 4; ++n) apart.of[n] = hn::Abs(hn::Sub(first.sum.of[n], second.sum.of[n]));
    const Vector colours = hn::Sub(across(apart), hn::Abs(hn::Sub(first.a, second.a)));
    const Vector sum = hn::Add(colours, hn::Mul(hn::Abs(hn::Sub(first.a, second.a)), number(2 * 255)));
    const Floats floats;
    const auto whole = hn::Add(hn::ConvertTo(floats, hn::ShiftRight<6>(sum)), hn::Set(floats, 0.5F));
    static_assert(kOpaque == 64 * 255);
    return hn::ConvertTo(Lanes(), hn::Mul(whole, hn::Set(floats, 1.0F / 255)));
}

// shape_layer() of the lanes `wanted`, for a surface at depth `d`. The score is left out where nobody asks.
template <bool kScored>
HWY_INLINE LayerLanes layer_lanes(const ShapeWalk& walk, const ShapeStrip& strip, int lane, Vector rise, Vector d,
                                  LaneMask first_sees, LaneMask second_sees, LaneMask wanted) {
    const auto load = [&](const std::int32_t* lanes) { return hn::Load(Lanes(), lanes + lane); };
    const auto used = [&](const ShapePictureLanes& picture) { return hn::MaskFromVec(load(picture.used)); };
    const Vector zero = hn::Zero(Lanes());
    LayerLanes layer;
    layer.lambda_q20 = hn::Add(load(strip.lambda0_q20), hn::ShiftRight<4>(hn::Mul(d, load(strip.lambda1_q24))));
    const LaneMask looked_at =
        hn::And(hn::And(wanted, hn::Gt(layer.lambda_q20, zero)), hn::Or(first_sees, second_sees));
    const Vector y_q16 = hn::Add(number(walk.b_q16), multiply_shift_within<28>(layer.lambda_q20, rise));
    const SampleLanes first = sample_lanes(walk, strip.first, lane, d, y_q16, hn::And(looked_at, used(strip.first)));
    const SampleLanes second = sample_lanes(walk, strip.second, lane, d, y_q16, hn::And(looked_at, used(strip.second)));

    const LaneMask transparent =
        hn::Or(hn::And(first.exists, hn::Eq(first.a, zero)), hn::And(second.exists, hn::Eq(second.a, zero)));
    const LaneMask show_first = hn::AndNot(transparent, hn::And(first.exists, first_sees));
    const LaneMask show_second = hn::AndNot(transparent, hn::And(second.exists, second_sees));
    const LaneMask shown = hn::Or(show_first, show_second);
    const LaneMask both = hn::And(show_first, show_second);
    layer.exists = hn::Or(shown, transparent);
    const Vector weight = hn::IfThenElse(both, load(strip.weight), hn::IfThenZeroElse(show_first, number(256)));
    const auto mixed = [](Vector f, Vector s, Vector w) {
        return hn::Add(hn::ShiftLeft<8>(f), hn::Mul(hn::Sub(s, f), w));
    };
    layer.a = hn::IfThenElseZero(shown, mixed(first.a, second.a, weight));
    layer.sum = for_channels(weight, [&](int n, Vector w) { return mixed(first.sum.of[n], second.sum.of[n], w); });
    layer.score = zero;
    if constexpr (kScored) {
        const Vector of_shown = hn::IfThenElse(both, disagreement_lanes(first, second), number(kSingleScore));
        layer.score = hn::IfThenElse(transparent, number(kTransparentScore), of_shown);
    }
    return layer;
}

HWY_INLINE LayerLanes choose(LaneMask mask, const LayerLanes& yes, const LayerLanes& no) {
    LayerLanes chosen;
    chosen.exists = hn::Or(hn::And(mask, yes.exists), hn::AndNot(mask, no.exists));
    chosen.score = hn::IfThenElse(mask, yes.score, no.score);
    chosen.a = hn::IfThenElse(mask, yes.a, no.a);
    chosen.lambda_q20 = hn::IfThenElse(mask, yes.lambda_q20, no.lambda_q20);
    chosen.sum = for_channels(hn::VecFromMask(Lanes(), mask), [&](int n, Vector which) {
        return hn::IfThenElse(hn::MaskFromVec(which), yes.sum.of[n], no.sum.of[n]);
    });
    return chosen;
}

// The better layer of the lanes `wanted`.
HWY_INLINE LayerLanes best_layer(const ShapeWalk& walk, const ShapeStrip& strip, int lane, Vector rise,
                                 const CellLanes& cell, LaneMask wanted) {
    const LaneMask first_sees = has_bits(cell.rays, kFirstSeesLayer0);
    const LaneMask second_sees = has_bits(cell.rays, kSecondSeesLayer0);
    const LaneMask two = hn::And(wanted, has_bits(cell.rays, kFirstSeesLayer1 | kSecondSeesLayer1));
    if (HWY_LIKELY(hn::AllFalse(Lanes(), two))) {
        return layer_lanes<false>(walk, strip, lane, rise, cell.depth0, first_sees, second_sees, wanted);
    }
    const LayerLanes best = layer_lanes<true>(walk, strip, lane, rise, cell.depth0, first_sees, second_sees, wanted);
    const LayerLanes other =
        layer_lanes<true>(walk, strip, lane, rise, cell.depth1, has_bits(cell.rays, kFirstSeesLayer1),
                          has_bits(cell.rays, kSecondSeesLayer1), two);
    const LaneMask better = hn::Lt(other.score, best.score);
    const LaneMask only = hn::AndNot(best.exists, other.exists);
    return choose(hn::Or(only, hn::And(other.exists, better)), other, best);
}

// shape_pixel() of as many lanes as a vector has, from `lane` on.
HWY_INLINE void walk_lanes(const ShapeWalk& walk, const ShapeStrip& strip, int lane, std::int32_t rise_q24,
                           std::int32_t* colour, std::int32_t* lambda) {
    const Vector zero = hn::Zero(Lanes());
    const Vector rise = number(rise_q24);
    const Vector alone_ray = hn::Load(Lanes(), strip.alone + lane);
    const LaneMask alone = hn::Ne(alone_ray, zero);
    MarchLanes march(walk, strip, lane, rise);
    Vector shown_colour = zero;
    Vector shown_lambda = zero;
    LaneMask looking = hn::MaskFromVec(
        hn::Or(hn::Load(Lanes(), strip.first.used + lane), hn::Load(Lanes(), strip.second.used + lane)));
    while (!hn::AllFalse(Lanes(), looking)) {
        CellLanes cell = march.next(looking);
        const LaneMask at_foot = hn::And(alone, hn::Eq(cell.rays, zero));
        cell.depth0 = hn::IfThenElse(at_foot, hn::Load(Lanes(), strip.foot_depth + lane), cell.depth0);
        cell.rays = hn::IfThenElse(alone, alone_ray, cell.rays);
        looking = hn::And(looking, hn::Ne(cell.rays, zero));
        if (hn::AllFalse(Lanes(), looking)) break;
        const LayerLanes layer = best_layer(walk, strip, lane, rise, cell, looking);
        const LaneMask shown = hn::And(layer.exists, hn::Gt(layer.a, zero));
        shown_colour = hn::IfThenElse(shown, resolve_lanes(layer.sum, layer.a), shown_colour);
        shown_lambda = hn::IfThenElse(shown, layer.lambda_q20, shown_lambda);
        looking = hn::AndNot(hn::Or(hn::Or(shown, alone), march.ended()), looking);
    }
    hn::StoreU(shown_colour, Lanes(), colour);
    if (lambda != nullptr) hn::StoreU(hn::IfThenZeroElse(hn::Eq(shown_colour, zero), shown_lambda), Lanes(), lambda);
}

bool can_walk() {
    return true;
}

void walk_shape_rows(const ShapeWalk& walk, const ShapeStrip& strip, const std::int32_t* rise_q24, int rows,
                     std::int32_t* colour, std::ptrdiff_t colour_stride, std::int32_t* lambda,
                     std::ptrdiff_t lambda_stride) {
    const int lanes = static_cast<int>(hn::Lanes(Lanes()));
    for (int j = 0; j < rows; ++j) {
        std::int32_t* const lambdas = lambda == nullptr ? nullptr : lambda + j * lambda_stride;
        for (int lane = 0; lane < kStripColumns; lane += lanes) {
            walk_lanes(walk, strip, lane, rise_q24[j], colour + j * colour_stride + lane,
                       lambdas == nullptr ? nullptr : lambdas + lane);
        }
    }
}

}  // namespace rs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

#if HWY_ONCE
namespace rs::engine {

HWY_EXPORT(can_walk);
HWY_EXPORT(walk_shape_rows);

bool can_walk_shape() {
    return HWY_DYNAMIC_DISPATCH(can_walk)();
}

void walk_shape(const ShapeWalk& walk, const ShapeStrip& strip, const std::int32_t* rise_q24, int rows, int columns,
                const ShapeWalkOutput& out) {
    static_assert(sizeof(Rgba8) == sizeof(std::int32_t) && sizeof(ShapeCell) == sizeof(std::int32_t));
    const auto width = static_cast<std::size_t>(columns);
    if (strip.empty) {
        for (int j = 0; j < rows; ++j) {
            std::fill_n(out.colour + j * out.colour_stride, width, Rgba8{});
            if (out.lambda_q20 != nullptr) std::fill_n(out.lambda_q20 + j * out.lambda_stride, width, 0);
        }
        return;
    }
    if (columns == kStripColumns) {
        HWY_DYNAMIC_DISPATCH(walk_shape_rows)
        (walk, strip, rise_q24, rows, reinterpret_cast<std::int32_t*>(out.colour), out.colour_stride, out.lambda_q20,
         out.lambda_stride);
        return;
    }
    // The view's right edge: row by row through a buffer.
    for (int j = 0; j < rows; ++j) {
        alignas(64) std::int32_t colour[kStripColumns];
        alignas(64) std::int32_t lambda[kStripColumns];
        HWY_DYNAMIC_DISPATCH(walk_shape_rows)
        (walk, strip, rise_q24 + j, 1, colour, 0, lambda, 0);
        std::memcpy(static_cast<void*>(out.colour + j * out.colour_stride), colour, width * sizeof(Rgba8));
        if (out.lambda_q20 != nullptr) std::copy_n(lambda, width, out.lambda_q20 + j * out.lambda_stride);
    }
}

}  // namespace rs::engine
#endif  // HWY_ONCE
