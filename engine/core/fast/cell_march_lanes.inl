// CellMarch on vectors, a pixel per lane. No include guard: shape_walk.cpp includes it once for each SIMD target.

#include "engine/core/definition/cell_march.hpp"
#include "engine/core/fast/shape_lanes.inl"
#include "engine/core/fast/shape_walk.hpp"

HWY_BEFORE_NAMESPACE();
namespace rs::engine::HWY_NAMESPACE {

HWY_INLINE LaneMask none() {
    return hn::Lt(hn::Zero(Lanes()), hn::Zero(Lanes()));
}

// 0 <= v < limit
HWY_INLINE LaneMask within(Vector v, Vector limit) {
    return hn::And(hn::Gt(limit, v), at_least(v, hn::Zero(Lanes())));
}

HWY_INLINE LaneMask is_surface(Vector depth_q3) {
    return at_least(depth_q3, hn::Zero(Lanes()));
}

enum class OfStack { first, behind };  // of SurfaceStack

// surfaces_between() of four depths [p][band], -1 where there is nothing; -1 where the answer is nothing. Their backs
// are known beforehand.
template <OfStack kWhich>
HWY_INLINE Vector between_steps(const Vector (&depth)[2][2], Vector p_part, Vector h_part, int jump) {
    const Vector zero = hn::Zero(Lanes());
    Vector nearest = number(1 << 12);
    Vector farthest = number(-1);
    for (const auto& column : depth) {
        for (const Vector d : column) {
            nearest = hn::Min(nearest, hn::IfThenElse(is_surface(d), d, nearest));
            farthest = hn::Max(farthest, d);
        }
    }
    const LaneMask steps = hn::Gt(hn::Sub(farthest, nearest), number(8 * jump));
    const Vector twice_middle = hn::IfThenElse(steps, hn::Add(nearest, farthest), number(1 << 13));
    const Vector p_h = hn::Mul(p_part, h_part);
    const Vector of_p = hn::Sub(hn::ShiftLeft<3>(p_part), p_h);  // p 1, the lower band
    const Vector of_h = hn::Sub(hn::ShiftLeft<3>(h_part), p_h);  // p 0, the upper band
    const Vector of_neither = hn::Sub(hn::Sub(number(64), p_h), hn::Add(of_p, of_h));
    const Vector weights[2][2] = {{of_neither, of_h}, {of_p, p_h}};
    Vector weight[2] = {zero, zero};  // of the nearer group, of the farther one
    Vector sum[2] = {zero, zero};
    for (int p = 0; p < 2; ++p) {
        for (int h = 0; h < 2; ++h) {
            const Vector d = depth[p][h];
            const LaneMask farther = hn::Gt(hn::Add(d, d), twice_middle);
            const Vector part = hn::IfThenElseZero(is_surface(d), weights[p][h]);
            const Vector parts[2] = {hn::IfThenZeroElse(farther, part), hn::IfThenElseZero(farther, part)};
            for (int group = 0; group < 2; ++group) {
                weight[group] = hn::Add(weight[group], parts[group]);
                sum[group] = hn::Add(sum[group], hn::Mul(parts[group], d));
            }
        }
    }
    const LaneMask nearer = at_least(weight[0], weight[1]);
    const auto of_group = [&](const Vector(&of)[2]) {
        return kWhich == OfStack::first ? hn::IfThenElse(nearer, of[0], of[1]) : hn::IfThenElseZero(nearer, of[1]);
    };
    const Vector divisor = of_group(weight);
    const Vector dividend = hn::Add(of_group(sum), hn::ShiftRight<1>(divisor));
    // Below 2^18 by at most 64: a float quotient that is no whole number keeps clear of them.
    const Floats floats;
    const Vector quotient = hn::ConvertTo(
        Lanes(), hn::Div(hn::ConvertTo(floats, dividend), hn::ConvertTo(floats, hn::Max(divisor, number(1)))));
    return hn::IfThenElse(hn::Gt(divisor, zero), quotient, number(-1));
}

// CellMarch for the lanes of one view row. Lanes march each at its own step until each has a surface.
class MarchLanes {
public:
    HWY_INLINE MarchLanes(const ShapeWalk& walk, const ShapeStrip& strip, int lane, Vector rise)
        : entries_(strip.entries),
          jump_(walk.jump),
          start_(hn::Load(Lanes(), strip.entry_start + lane)),
          last_(hn::Load(Lanes(), strip.last_entry + lane)),
          p_part_(hn::Load(Lanes(), strip.p_part + lane)),
          beyond_(hn::Load(Lanes(), strip.beyond + lane)),
          begin_(number(256)),
          step_(number(256)) {
        const Vector h = hn::Add(number(walk.b_q16),
                                 multiply_shift_within<28>(hn::Load(Lanes(), strip.lambda_foot_q20 + lane), rise));
        const auto shifted = [&](auto shift, Vector a, Vector b) {
            return strip.level ? multiply_shift_within<decltype(shift)::value>(a, b)
                               : multiply_shift<decltype(shift)::value>(a, b);
        };
        using By12 = std::integral_constant<int, 12>;
        using By16 = std::integral_constant<int, 16>;
        const Vector per_unit = number(walk.bands_per_unit_q12);
        // Counted from the middle of the first entry's band.
        foot_ = hn::Sub(shifted(By16(), hn::Sub(h, number(walk.h_low_q16)), per_unit),
                        hn::Load(Lanes(), strip.first_middle_q12 + lane));
        const Vector slope = multiply_shift_within<24>(hn::Load(Lanes(), strip.inverse_r_q20 + lane), rise);
        const Vector reference = shifted(By16(), hn::Sub(h, number(walk.reference_height_q16)),
                                         hn::Load(Lanes(), strip.inverse_rho_q20 + lane));
        const Vector per_radius = shifted(By12(), hn::Sub(slope, reference), per_unit);
        zero_ = hn::Add(foot_, multiply_shift_within<28>(per_radius, number(walk.depth_low_q20)));
        per_depth_ = multiply_shift_within<24>(per_radius, number(walk.depth_step_q24));
        if (!strip.level) begin_march(hn::Load(Lanes(), strip.nearest + lane));
    }

    // Depths of the lanes `looking`, -1 where there is nothing; others get any.
    HWY_INLINE Vector next(LaneMask looking) {
        Vector found = number(-1);
        LaneMask marching = hn::And(looking, hn::Lt(begin_, beyond_));
        while (!hn::AllFalse(Lanes(), marching)) {
            const Vector begin = begin_;
            const Vector end = hn::Add(begin, step_);
            const Vector at = band(hn::Add(begin, hn::ShiftRight<1>(step_)));
            const Vector depth = surface_at(at, marching);
            const LaneMask reached = hn::And(is_surface(depth), at_least(hn::ShiftLeft<3>(end), depth));
            const LaneMask in_reach = hn::And(reached, marching);
            if (!hn::AllFalse(Lanes(), in_reach)) {
                const Vector back = hn::And(backs_at(entry_at(at)), number((1 << 16) - 1));
                const LaneMask hit = hn::And(in_reach, at_least(back, begin));
                found = hn::IfThenElse(hit, hn::Max(depth, hn::ShiftLeft<3>(begin)), found);
                begin_ = hn::IfThenElse(marching, end, begin);
                marching = hn::AndNot(hit, hn::And(marching, hn::Lt(end, beyond_)));
            } else {
                begin_ = hn::IfThenElse(marching, end, begin);
                marching = hn::And(marching, hn::Lt(end, beyond_));
            }
        }
        const LaneMask last = hn::And(looking, hn::AndNot(ended_, hn::Not(is_surface(found))));
        if (hn::AllFalse(Lanes(), last)) return found;
        ended_ = hn::Or(ended_, last);
        Vector depth = surface_at(foot_, last);
        const Vector there_at = band(hn::ShiftRight<3>(depth));
        const LaneMask elsewhere =
            hn::AndNot(hn::Eq(hn::ShiftRight<9>(there_at), hn::ShiftRight<9>(foot_)), hn::And(last, is_surface(depth)));
        if (!hn::AllFalse(Lanes(), elsewhere)) {
            const Vector there = surface_at(there_at, elsewhere);
            depth = hn::IfThenElse(hn::And(elsewhere, is_surface(there)), there, depth);
        }
        return hn::IfThenElse(last, depth, found);
    }

    // Lanes that have no surface left but those still_to_come().
    [[nodiscard]] HWY_INLINE LaneMask ended() const { return ended_; }

    // What is still to come of the lanes `looking`, all of which have ended with a surface: -1 where there is nothing.
    // Few rays ask, so the last surface's place is found again rather than kept.
    struct StillToCome {
        Vector behind;
        Vector farthest;
    };
    [[nodiscard]] HWY_INLINE StillToCome still_to_come(LaneMask looking) const {
        const Vector there_at = band(hn::ShiftRight<3>(surface_at(foot_, looking)));
        const Vector at = hn::IfThenElse(is_surface(surface_at(there_at, looking)), there_at, foot_);
        const Vector entry = entry_at(at);
        const Vector smooth = hn::GatherIndex(Lanes(), entries_.smooth.data(), entry);
        const LaneMask steps = hn::And(looking, says(smooth, kSurfaceSteps));
        StillToCome surfaces{number(-1), hn::ShiftRight<16>(backs_at(entry))};
        if (hn::AllFalse(Lanes(), steps)) return surfaces;
        surfaces.behind = hn::IfThenElse(steps, at_step<OfStack::behind>(at, entry, steps), surfaces.behind);
        return surfaces;
    }

private:
    HWY_INLINE void begin_march(Vector nearest) {
        per_depth_ =
            hn::Min(hn::Max(per_depth_, number(-CellMarch::kMostPerDepth_q20)), number(CellMarch::kMostPerDepth_q20));
        const Vector steps =
            hn::Min(hn::Add(hn::ShiftRight<11>(hn::Abs(per_depth_)), number(1)), number(CellMarch::kMostSteps));
        const LaneMask one = hn::Eq(steps, number(1));
        if (hn::AllTrue(Lanes(), one)) return;
        // Whole numbers by float division: the halves keep the quotients clear of them.
        const Floats floats;
        step_ = hn::ConvertTo(Lanes(), hn::Div(hn::Set(floats, 256.5F), hn::ConvertTo(floats, steps)));
        // A ray that stays above or below all bands meets nothing.
        const Vector from = band(hn::Zero(Lanes()));
        const Vector to = band(hn::Add(beyond_, step_));
        const LaneMask below = hn::Lt(hn::Max(from, to), hn::Zero(Lanes()));
        const LaneMask beside = hn::Or(below, at_least(hn::Min(from, to), hn::ShiftLeft<12>(last_)));
        // The first step that reaches the nearest surface, (nearest - 1) / step; those before it can meet none.
        const auto before = hn::Sub(hn::ConvertTo(floats, nearest), hn::Set(floats, 0.5F));
        const Vector skipped = hn::ConvertTo(Lanes(), hn::Div(before, hn::ConvertTo(floats, step_)));
        begin_ = hn::IfThenElse(hn::Or(one, beside), number(256), hn::Mul(skipped, step_));
    }

    HWY_INLINE Vector band(Vector d) const { return hn::Add(zero_, hn::ShiftRight<8>(hn::Mul(d, per_depth_))); }

    // Index of a place's entry: the first or the last one for those beyond, which say nothing.
    HWY_INLINE Vector entry_at(Vector at_q12) const {
        const Vector entry = hn::Min(hn::Max(hn::ShiftRight<12>(at_q12), hn::Zero(Lanes())), last_);
        return hn::Add(start_, entry);
    }

    // Of entries' `smooth`.
    static HWY_INLINE LaneMask says(Vector smooth, std::int32_t bit) {
        return hn::Ne(hn::And(smooth, number(bit)), hn::Zero(Lanes()));
    }

    HWY_INLINE Vector backs_at(Vector entry) const { return hn::GatherIndex(Lanes(), entries_.backs.data(), entry); }

    HWY_INLINE Vector surface_at(Vector at_q12, LaneMask wanted) const {
        const Vector entry = entry_at(at_q12);
        const Vector h_part = hn::And(hn::ShiftRight<9>(at_q12), number(7));
        const Vector smooth = hn::GatherIndex(Lanes(), entries_.smooth.data(), entry);
        const Vector low = hn::And(smooth, number((1 << kLowBits) - 1));
        const Vector sum = hn::Add(hn::ShiftLeft<3>(low), hn::Mul(h_part, hn::ShiftRight<16>(smooth)));
        const Vector depth = hn::ShiftRight<6>(hn::Add(sum, number(32)));
        const Vector known = hn::IfThenElse(says(smooth, kSurfaceNothing), number(-1), depth);
        const LaneMask steps = says(smooth, kSurfaceSteps);
        if (hn::AllFalse(Lanes(), hn::And(steps, wanted))) return known;
        return hn::IfThenElse(steps, at_step<OfStack::first>(at_q12, entry, steps), known);
    }

    // A surface where `entry`, that of the place, says that cells differ; others get any.
    template <OfStack kWhich>
    HWY_INLINE Vector at_step(Vector at_q12, Vector entry, LaneMask steps) const {
        const auto pair_at = [&](Vector index) { return hn::GatherIndex(Lanes(), entries_.pairs.data(), index); };
        const Vector lower = pair_at(entry);
        const Vector upper = pair_at(hn::Add(entry, hn::IfThenElseZero(steps, number(1))));
        const auto first = [](Vector pair) { return hn::ShiftRight<16>(hn::ShiftLeft<16>(pair)); };
        const auto second = [](Vector pair) { return hn::ShiftRight<16>(pair); };
        const Vector depths[2][2] = {{first(lower), first(upper)}, {second(lower), second(upper)}};
        const Vector h_part = hn::And(hn::ShiftRight<9>(at_q12), number(7));
        return between_steps<kWhich>(depths, p_part_, h_part, jump_);
    }

    const SurfaceEntries& entries_;
    int jump_;
    Vector start_;
    Vector last_;
    Vector p_part_;
    Vector beyond_;
    Vector begin_;
    Vector step_;
    Vector foot_;
    Vector zero_;
    Vector per_depth_;
    LaneMask ended_ = none();
};

}  // namespace rs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
