// engine/RECONSTRUCTION.md, section 6.
#include "tests/reference/view/reference_shape.hpp"

#include <algorithm>
#include <vector>

namespace rs::reference {
namespace {

// No surface, or a depth in eighths of a step and a lean.
struct Surface {
    Whole depth = 0;
    Whole lean = 0;
};
using Found = std::optional<Surface>;

// "surface(v)", "behind(v)", "farthest(v)" and "deepest(v)"
struct Surfaces {
    Found surface;
    Found behind;
    Found farthest;
    Whole deepest = 0;  // 0 if there is no surface, as stated by surface(v)
};

struct Bands {
    Whole at_foot = 0, per_d = 0;
    Whole low = 0, reference = 0;  // q3

    // "E(d)"
    [[nodiscard]] Whole effective(Whole d) const {
        const Whole s = low + 8 * std::min<Whole>(d, 255);
        const Whole squared = below(s * s, 28.4, "s * s");
        const Whole divisor = within(std::max(reference + s, (reference + 1) >> 1), 256, power(29), "reference + s");
        return clamp(s - floor_div(squared, divisor), -4095, 4095);
    }
    [[nodiscard]] Whole band_at(Whole d) const {
        const Whole change = below(effective(d) * (per_d >> 3), 31, "E(d) * (per_d >> 3)") >> 8;
        return below(at_foot + change, std::log2(std::exp2(29) + std::exp2(23)), "band_at");
    }
};

Bands bands_of(const ShapeMap& shape, const engine::ViewRegisters& view, const ShapeRay& ray, Whole rise,
               Branches& branches) {
    const double kHeight = std::log2(std::exp2(24) + std::exp2(28.3));
    const Whole h =
        (view.b_q20 >> 4) + never_held(below(ray.lambda_foot * rise, 56.3, "lambda_foot * rise") >> 28, "h");
    below(h, kHeight, "h");
    const Whole slope = at_most(never_held(below(rise * ray.inv_r, 51.01, "rise * inv_r") >> 24, "slope"), 27, "slope");
    const Whole above_reference = below(h - (shape.reference_height_q20 >> 4), 28.3, "h - (H_ref >> 4)");
    const Whole ref = hold((above_reference * ray.inv_rho) >> 16);
    const Whole difference = below(slope - ref, 29.4, "slope - ref");
    const Whole drift =
        hold(below(difference * shape.bands_per_unit_q12, 55.4, "(slope - ref) * bands_per_unit") >> 12);
    Bands bands;
    bands.at_foot = hold(((h - (shape.h_low_q20 >> 4)) * shape.bands_per_unit_q12) >> 16);
    const Whole unclamped = never_held((drift * shape.depth_step_q24) >> 24, "per_d");
    bands.per_d = clamp(unclamped, -power(22), power(22));
    bands.low = clamp(floor_div(128 * Whole{shape.depth_low_q20}, shape.depth_step_q24), -power(14), power(14));
    bands.reference = std::min(floor_div(128 * Whole{shape.reference_distance_q20}, shape.depth_step_q24), power(28));
    if (bands.per_d != unclamped) branches.take(Branch::band_drift_clamped);
    return bands;
}

class CellsAround {
public:
    CellsAround(const ShapeMap& shape, const ShapeRay& ray, Branches& branches)
        : shape_(shape), ray_(ray), branches_(branches) {}

    Surfaces at(Whole v) {
        struct Weighted {
            Surface surface;
            Whole weight;
        };
        std::vector<Weighted> of_four;
        below(v - 2048, std::log2(std::exp2(29) + std::exp2(23.3)), "v - 2048");
        const Whole hi = (v - 2048) >> 12;
        const Whole h_part = ((v - 2048) >> 9) & 7;
        Whole all_weights = 0;
        for (const std::size_t c : {std::size_t{0}, std::size_t{1}}) {
            for (const Whole band : {hi, hi + 1}) {
                const Whole weight = (c == 0 ? 8 - ray_.p_part : ray_.p_part) * (band == hi ? 8 - h_part : h_part);
                all_weights += weight;
                if (band < 0 || band >= shape_.bands) {
                    branches_.take(Branch::band_does_not_exist);
                } else if (const Found found = between_lines(c, band)) {
                    of_four.push_back({*found, weight});
                }
            }
        }
        within(all_weights, 64, 64, "the four weights");
        if (of_four.empty()) {
            branches_.take(Branch::nothing_of_four);
            return {};
        }
        Whole near = of_four[0].surface.depth, far = near;
        for (const Weighted& one : of_four) {
            near = std::min(near, one.surface.depth);
            far = std::max(far, one.surface.depth);
        }
        struct Group {
            Whole weights = 0, depths = 0, leans = 0;
        };
        Group nearer, farther;
        const bool are_two = far - near > 8 * shape_.jump;
        for (const auto& [surface, weight] : of_four) {
            Group& group = !are_two || 2 * surface.depth <= near + far ? nearer : farther;
            group.weights += weight;
            group.depths += weight * surface.depth;
            group.leans += weight * surface.lean;
        }
        const auto surface_of = [&](const Group& group) -> Found {
            within(group.weights, 0, 64, "weights");
            within(group.depths, 0, 64 * 2040, "depths");
            if (group.weights == 0) return {};
            const Whole sum = below(group.depths + floor_div(group.weights, 2), 17, "depths + floor(weights / 2)");
            within(group.leans, 0, 64 * 16, "leans");
            const Whole lean = floor_div(group.leans + floor_div(group.weights, 2), group.weights);
            return Surface{within(floor_div(sum, group.weights), 0, 2040, "depth"), within(lean, 0, 16, "lean")};
        };
        const bool takes_nearer = nearer.weights >= farther.weights;
        if (nearer.weights == 0 && farther.weights == 0) {
            branches_.take(Branch::nothing_has_weight);
            return {};
        }
        branches_.take(!are_two                            ? Branch::one_group
                       : !takes_nearer                     ? Branch::farther_group
                       : nearer.weights == farther.weights ? Branch::nearer_group_of_equals
                                                           : Branch::nearer_group);
        const Eight eight = of_eight(hi);
        const Found farthest = eight.count == 8 ? Found(Surface{8 * eight.deepest, 8}) : Found();
        if (!takes_nearer) return {surface_of(farther), {}, farthest, eight.deepest};
        return {surface_of(nearer), surface_of(farther), farthest, eight.deepest};
    }

private:
    // Those of the eight surrounding cells that have a surface, in the bands hi and hi + 1.
    struct Eight {
        int count = 0;
        Whole deepest = 0;
    };
    [[nodiscard]] Eight of_eight(Whole hi) const {
        Eight eight;
        for (const std::size_t c : {std::size_t{0}, std::size_t{1}}) {
            for (const std::size_t line : {std::size_t{0}, std::size_t{1}}) {
                for (const Whole band : {hi, hi + 1}) {
                    if (band < 0 || band >= shape_.bands || cell(c, line, band).shown == 0) continue;
                    ++eight.count;
                    eight.deepest =
                        within(std::max<Whole>(eight.deepest, cell(c, line, band).depth), 0, 255, "deepest");
                }
            }
        }
        return eight;
    }

    [[nodiscard]] ShapeCell cell(std::size_t c, std::size_t n, Whole hi) const {
        const Whole index = (ray_.line[n] * shape_.p_cells + ray_.cell_p[c]) * shape_.bands + hi;
        require(index >= 0, "a cell's index", index);
        return shape_.cells.at(static_cast<std::size_t>(below(index, 27, "a cell's index")));
    }

    // "leans": of one cell
    [[nodiscard]] Whole lean_of(const ShapeCell& e) const {
        if (e.shown == 1) {
            branches_.take(Branch::first_shows_alone);
            return 0;
        }
        if (e.shown == 2) {
            branches_.take(Branch::second_shows_alone);
            return 2;
        }
        return 1;
    }

    // "Between the two lines"
    Found between_lines(std::size_t c, Whole hi) {
        const ShapeCell e = cell(c, 0, hi);
        const ShapeCell e2 = ray_.line_part > 0 ? cell(c, 1, hi) : ShapeCell{};
        if (e.shown == 0 && e2.shown == 0) {
            branches_.take(Branch::no_cell_of_two);
            return {};
        }
        if (e2.shown == 0) {
            branches_.take(Branch::first_cell_alone);
            return Surface{8 * Whole{e.depth}, 8 * lean_of(e)};
        }
        if (e.shown == 0) {
            branches_.take(Branch::second_cell_alone);
            return Surface{8 * Whole{e2.depth}, 8 * lean_of(e2)};
        }
        const Whole change = Whole{e2.depth} - e.depth;
        if (change > shape_.jump || -change > shape_.jump) {
            const bool takes_first = ray_.line_part < 4;
            branches_.take(takes_first ? Branch::lines_jump_to_first : Branch::lines_jump_to_second);
            return Surface{8 * Whole{takes_first ? e.depth : e2.depth}, 8 * lean_of(takes_first ? e : e2)};
        }
        branches_.take(Branch::lines_interpolated);
        const Whole lean = (8 - ray_.line_part) * lean_of(e) + ray_.line_part * lean_of(e2);
        return Surface{8 * Whole{e.depth} + ray_.line_part * change, lean};
    }

    const ShapeMap& shape_;
    const ShapeRay& ray_;
    Branches& branches_;
};

}  // namespace

void march(const ShapeMap& shape, const engine::ViewRegisters& view, const ShapeRay& ray, Whole rise,
           const std::function<bool(Whole d, Whole lean, bool at_end)>& meets, Branches& branches) {
    const Bands bands = bands_of(shape, view, ray, rise, branches);
    CellsAround cells(shape, ray, branches);
    const Whole swept = bands.per_d < 0 ? -bands.per_d : bands.per_d;
    const Whole steps = within(std::min<Whole>((swept >> 11) + 1, 64), 1, 64, "steps");
    const Whole size = within(floor_div(256, steps), 4, 256, "size");
    branches.take(steps == 1 ? Branch::one_step : Branch::many_steps);
    if (steps == 64) branches.take(Branch::most_steps);
    if (steps > 1) {
        int looks = 0;
        for (Whole begin = 0; begin < 256; begin = begin + size) {
            within(++looks, 1, 64, "looks of the march");
            const Surfaces at_v = cells.at(bands.band_at(begin + (size >> 1)));
            const Found& e = at_v.surface;
            if (!e) {
                branches.take(Branch::not_met_nothing);
            } else if (e->depth > 8 * (begin + size)) {
                branches.take(Branch::not_met_behind_the_step);
            } else if (at_v.deepest + shape.thickness < begin) {
                branches.take(Branch::not_met_ends_before);
            } else {
                branches.take(e->depth > 8 * begin ? Branch::met_within_the_step : Branch::met_at_the_step);
                if (meets(std::max(e->depth, 8 * begin), e->lean, false)) return;
            }
        }
    }
    const Surfaces at_foot = cells.at(bands.at_foot);
    if (!at_foot.surface) {
        branches.take(Branch::end_is_nothing);
        return;
    }
    const Surfaces at_v2 = cells.at(bands.band_at(at_foot.surface->depth >> 3));
    branches.take(at_v2.surface ? Branch::second_look : Branch::second_look_is_nothing);
    const Surfaces& last = at_v2.surface ? at_v2 : at_foot;
    if (meets(last.surface->depth, last.surface->lean, true)) return;
    branches.take(last.behind ? Branch::met_behind : Branch::nothing_behind);
    if (last.behind && meets(last.behind->depth, last.behind->lean, true)) return;
    branches.take(last.farthest ? Branch::met_farthest : Branch::one_of_eight_lacks);
    if (last.farthest) meets(last.farthest->depth, last.farthest->lean, true);
}

}  // namespace rs::reference
