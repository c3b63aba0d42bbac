// CellMarch on vectors, a pixel per lane. No include guard: shape_walk.cpp includes it once for each SIMD target.

#include "engine/core/cell_march.hpp"
#include "engine/core/shape_lanes.inl"
#include "engine/core/shape_walk.hpp"

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

}  // namespace rs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
