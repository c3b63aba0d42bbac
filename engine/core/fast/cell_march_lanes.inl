// SIMD implementation of CellMarch, one row of the column per lane. No include guard: blend_surface_lanes.inl, which
// shape_walk.cpp includes, includes it once for each SIMD target.

#include "engine/core/definition/cell_march.hpp"
#include "engine/core/fast/shape_lanes.inl"

HWY_BEFORE_NAMESPACE();
namespace rs::engine::HWY_NAMESPACE {

HWY_INLINE LaneMask none() {
    return hn::Lt(hn::Zero(Lanes()), hn::Zero(Lanes()));
}

// 0 <= v < limit
HWY_INLINE LaneMask within(Vector v, std::int32_t limit) {
    const hn::RebindToUnsigned<Lanes> bits;
    return hn::RebindMask(Lanes(), hn::Lt(hn::BitCast(bits, v), hn::BitCast(bits, number(limit))));
}

// A surface is packed into 32 bits: depth_q3 in the lower kDepthBits, lean above (surface_column.hpp); -1: no surface.
HWY_INLINE LaneMask is_surface(Vector surface) {
    return hn::Gt(surface, number(-1));
}

HWY_INLINE Vector depth_of(Vector surface) {
    return hn::And(surface, number((1 << kDepthBits) - 1));
}

HWY_INLINE Vector shown_by_both(Vector depth_q3) {
    return hn::Or(depth_q3, number(kBothShow << kDepthBits));
}

// CellMarch for rows of one view column. Each lane has its own step size and marches until it has a surface.
class MarchLanes {
public:
    MarchLanes() = default;

    HWY_INLINE MarchLanes(const ShapeWalk& walk, const ShapeColumn& column, Vector rise)
        : column_(&column),
          effective_depth_(walk.effective_depth_q3.data()),
          thickness_(number(walk.thickness)),
          begin_(number(256)),
          step_(number(256)) {
        const Vector h = hn::Add(number(walk.b_q16), multiply_shift_within<28>(number(column.lambda_foot_q20), rise));
        const auto shifted = [&](auto shift, Vector a, Vector b) {
            return column.level ? multiply_shift_within<decltype(shift)::value>(a, b)
                                : multiply_shift<decltype(shift)::value>(a, b);
        };
        using By12 = std::integral_constant<int, 12>;
        using By16 = std::integral_constant<int, 16>;
        const Vector per_unit = number(walk.bands_per_unit_q12);
        // Relative to the centre of the first entry's band.
        foot_ = hn::Sub(shifted(By16(), hn::Sub(h, number(walk.h_low_q16)), per_unit), number(column.first_middle_q12));
        const Vector slope = multiply_shift_within<24>(number(column.inverse_r_q20), rise);
        const Vector reference =
            shifted(By16(), hn::Sub(h, number(walk.reference_height_q16)), number(column.inverse_rho_q20));
        const Vector per_radius = shifted(By12(), hn::Sub(slope, reference), per_unit);
        const Vector per_depth_q20 = multiply_shift_within<24>(per_radius, number(walk.depth_step_q24));
        ended_ = none();
        behind_ = number(-1);
        last_at_ = foot_;
        if (column.level) {
            per_depth_q17_ = hn::ShiftRight<3>(per_depth_q20);
        } else {
            begin_march(per_depth_q20);
        }
    }

    // Next surfaces of the lanes `active`; the results of other lanes are undefined.
    HWY_INLINE Vector next(LaneMask active) {
        Vector found = number(-1);
        const Vector beyond = number(column_->beyond);
        LaneMask marching = hn::And(active, hn::Lt(begin_, beyond));
        while (!hn::AllFalse(Lanes(), marching)) {
            const Vector begin = begin_;
            const Vector end = hn::Add(begin, step_);
            const Vector at = band(hn::Add(begin, hn::ShiftRight<1>(step_)));
            const Vector surface = surfaces_at(at, marching).first;
            const Vector depth = depth_of(surface);
            const LaneMask reached = hn::And(is_surface(surface), at_least(hn::ShiftLeft<3>(end), depth));
            const LaneMask in_reach = hn::And(reached, marching);
            if (!hn::AllFalse(Lanes(), in_reach)) {
                const Vector deepest = hn::And(look_up(column_->deepest, entry_at(at)), number(0xFFFF));
                const LaneMask hit = hn::And(in_reach, at_least(hn::Add(deepest, thickness_), begin));
                const Vector farther = hn::Max(hn::Sub(hn::ShiftLeft<3>(begin), depth), hn::Zero(Lanes()));
                found = hn::IfThenElse(hit, hn::Add(surface, farther), found);
                begin_ = hn::IfThenElse(marching, end, begin);
                marching = hn::AndNot(hit, hn::And(marching, hn::Lt(end, beyond)));
            } else {
                begin_ = hn::IfThenElse(marching, end, begin);
                marching = hn::And(marching, hn::Lt(end, beyond));
            }
        }
        const LaneMask last = hn::And(active, hn::AndNot(ended_, hn::Not(is_surface(found))));
        if (hn::AllFalse(Lanes(), last)) return found;
        ended_ = hn::Or(ended_, last);
        Surfaces of_last = surfaces_at(foot_, last);
        const Vector there_at = band(hn::ShiftRight<3>(depth_of(of_last.first)));
        const LaneMask elsewhere = hn::AndNot(hn::Eq(hn::ShiftRight<9>(there_at), hn::ShiftRight<9>(foot_)),
                                              hn::And(last, is_surface(of_last.first)));
        if (!hn::AllFalse(Lanes(), elsewhere)) {
            const Surfaces there = surfaces_at(there_at, elsewhere);
            const LaneMask moves = hn::And(elsewhere, is_surface(there.first));
            of_last.first = hn::IfThenElse(moves, there.first, of_last.first);
            of_last.behind = hn::IfThenElse(moves, there.behind, of_last.behind);
            last_at_ = hn::IfThenElse(moves, there_at, last_at_);
        }
        behind_ = hn::IfThenElse(last, of_last.behind, behind_);
        return hn::IfThenElse(last, of_last.first, found);
    }

    // Lanes whose march has ended; behind() and farthest() may still be surfaces.
    [[nodiscard]] HWY_INLINE LaneMask ended() const { return ended_; }

    // Surfaces behind the last one of lanes that have ended; -1 in all other lanes.
    [[nodiscard]] HWY_INLINE Vector behind() const { return behind_; }

    // SurfaceStack::farthest at the last surface of lanes that have ended.
    [[nodiscard]] HWY_INLINE Vector farthest() const {
        const Vector deepest = look_up(column_->deepest, entry_at(last_at_));
        return hn::IfThenElse(is_surface(deepest), shown_by_both(hn::ShiftLeft<3>(deepest)), number(-1));
    }

private:
    HWY_INLINE void begin_march(Vector unclamped_q20) {
        const Vector per_depth_q20 =
            hn::Min(hn::Max(unclamped_q20, number(-CellMarch::kMaxPerDepth_q20)), number(CellMarch::kMaxPerDepth_q20));
        per_depth_q17_ = hn::ShiftRight<3>(per_depth_q20);
        const Vector steps =
            hn::Min(hn::Add(hn::ShiftRight<11>(hn::Abs(per_depth_q20)), number(1)), number(CellMarch::kMaxSteps));
        const LaneMask one = hn::Eq(steps, number(1));
        if (hn::AllTrue(Lanes(), one)) return;
        // Exact integer division in float: the added half keeps quotients away from integers.
        const Floats floats;
        step_ = hn::ConvertTo(Lanes(), hn::Div(hn::Set(floats, 256.5F), hn::ConvertTo(floats, steps)));
        // A ray that stays above or below all bands meets nothing.
        const Vector from = band_at(number(effective_depth_[0]));
        const Vector to = band_at(number(effective_depth_[EffectiveDepth::kDepths - 1]));
        const LaneMask below = hn::Lt(hn::Max(from, to), hn::Zero(Lanes()));
        const LaneMask beside = hn::Or(below, at_least(hn::Min(from, to), number(column_->last_entry << 12)));
        // Skips the steps before the one that reaches the nearest surface, (nearest - 1) / step of them: they meet no
        // surface. A step is at most 256 / steps.
        const Vector skipped = hn::ShiftRight<8>(hn::Mul(steps, number(std::max(column_->nearest - 1, 0))));
        begin_ = hn::IfThenElse(hn::Or(one, beside), number(256), hn::Mul(skipped, step_));
    }

    HWY_INLINE Vector band_at(Vector effective_q3) const {
        return hn::Add(foot_, hn::ShiftRight<8>(hn::Mul(effective_q3, per_depth_q17_)));
    }

    HWY_INLINE Vector band(Vector d) const {
        return band_at(look_up(effective_depth_, hn::Min(d, number(EffectiveDepth::kDepths - 1))));
    }

    // Index of the entry at a band coordinate. Coordinates beyond the ends get the first or the last entry, which hold
    // no surface.
    HWY_INLINE Vector entry_at(Vector at_q12) const {
        return hn::Min(hn::Max(hn::ShiftRight<12>(at_q12), hn::Zero(Lanes())), number(column_->last_entry));
    }

    // Tests a flag of SurfaceEntries::smooth.
    static HWY_INLINE LaneMask has_flag(Vector smooth, std::int32_t bit) {
        return hn::Ne(hn::And(smooth, number(bit)), hn::Zero(Lanes()));
    }

    struct Surfaces {  // members of SurfaceStack
        Vector first;
        Vector behind;
    };

    HWY_INLINE Surfaces surfaces_at(Vector at_q12, LaneMask requested) const {
        const Vector h_part = hn::And(hn::ShiftRight<9>(at_q12), number(7));
        const Vector smooth = look_up(column_->smooth, entry_at(at_q12));
        const Vector low = hn::And(smooth, number((1 << kLowBits) - 1));
        const Vector sum = hn::Add(hn::ShiftLeft<3>(low), hn::Mul(h_part, hn::ShiftRight<16>(smooth)));
        const Vector depth = hn::ShiftRight<6>(hn::Add(sum, number(32)));
        const Vector known = hn::IfThenElse(has_flag(smooth, kSurfaceNothing), number(-1), shown_by_both(depth));
        const LaneMask steps = has_flag(smooth, kSurfaceSteps);
        if (hn::AllFalse(Lanes(), hn::And(steps, requested))) return {known, number(-1)};
        const Vector both = hn::GatherIndex(Lanes(), column_->steps, hn::IfThenElseZero(steps, sum));
        const hn::RebindToUnsigned<Lanes> bits;
        const auto surface = [](Vector in_16_bits) {
            return hn::IfThenElse(hn::Eq(in_16_bits, number(kNoSurface)), number(-1), in_16_bits);
        };
        const Vector behind = hn::BitCast(Lanes(), hn::ShiftRight<16>(hn::BitCast(bits, both)));
        return {hn::IfThenElse(steps, surface(hn::And(both, number(0xFFFF))), known),
                hn::IfThenElse(steps, surface(behind), number(-1))};
    }

    const ShapeColumn* column_;
    const std::int32_t* effective_depth_;
    Vector thickness_;
    Vector begin_;
    Vector step_;
    Vector foot_;
    Vector per_depth_q17_;
    Vector behind_;
    Vector last_at_;  // band coordinate of the last surface
    LaneMask ended_;
};

}  // namespace rs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
