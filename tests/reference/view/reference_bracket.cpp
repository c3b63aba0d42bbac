// engine/RECONSTRUCTION.md, section 5.
#include "tests/reference/view/reference_shape.hpp"

#include <algorithm>

namespace rs::reference {
namespace {

constexpr Whole kWidest_q20 = power(21) + power(16);  // "|.| < 2^21 + 2^16"

// "The vertical plane of the ray." Returns false if there is no ray.
bool find_vertical_plane(const ShapeMap& shape, const engine::PlaneRegisters& plane, const PlaneRay& at,
                         ShapeRay& ray) {
    const Whole a = plane.a_q20;
    const Whole c = plane.c_q20;
    within(at.n, power(24), power(31) - 1, "n");
    const Whole r = ray.r = isqrt(below(at.n * at.n + at.T * at.T, 63, "n * n + T * T"));
    require(r >= power(24), "r", r);
    below(r, 31.5, "r");
    ray.cosine = at_most(floor_div(below(at.n << 30, 61, "n << 30"), r), 30, "cosine");
    ray.sine = at_most(floor_div(below(at.T << 30, 61, "T << 30"), r), 30, "sine");
    const Whole p = ray.p = below(at.x * ray.cosine, 51.1, "x * cosine") >> 30;
    within(p, 1 - kWidest_q20, kWidest_q20 - 1, "p");
    const Whole to = at_most(below(c * ray.cosine - a * ray.sine, 59, "c * cosine - a * sine") >> 30, 29, "to");
    ray.lambda_foot = floor_div(at_most(to << 28, 57, "to << 28"), r);
    if (ray.lambda_foot <= -power(29) || ray.lambda_foot >= power(29)) return false;
    ray.inv_r = within(floor_div(power(48), r), power(16), power(24), "inv_r");
    const Whole D_ref = shape.reference_distance_q20;
    const Whole square = below(D_ref * D_ref, 56, "D_ref * D_ref");
    const Whole rho = isqrt(std::max(square - p * p, floor_div(square, 4)));
    require(rho >= power(19), "rho", rho);
    ray.inv_rho = at_most(floor_div(power(40), rho), 21, "inv_rho");
    return true;
}

// A ring's views, gaps and lines with cyclic numbers: N - 1 is followed by 0.
struct CyclicRing {
    const Ring& ring;
    Whole N = static_cast<Whole>(ring.views.size());

    [[nodiscard]] Whole held(Whole g) const { return ((g % N) + N) % N; }
    [[nodiscard]] std::size_t index(Whole g) const { return static_cast<std::size_t>(held(g)); }
    [[nodiscard]] const ShapeGap& gap(Whole g) const { return ring.shape.gaps[index(g)]; }
    [[nodiscard]] Whole S(Whole g) const { return gap(g).lines; }
    [[nodiscard]] const NormalLine& normal_line(Whole g, std::size_t k) const {
        return ring.shape.normal_lines[index(g) * static_cast<std::size_t>(ring.planes) + k];
    }
};

Whole X_of(const CyclicRing& turning, Whole g, const PlaneRay& at) {
    const NormalLine& captured = turning.normal_line(g, at.k);
    const Whole va = below(captured.a_q20, 28, "va");
    const Whole vc = below(captured.c_q20, 28, "vc");
    const Whole X = va + (below(at.u * vc, 57, "u * vc") >> 28);
    require(X > -(power(28) + power(29)) && X < power(28) + power(29), "X", X);
    return X;
}

// "The bracket."
std::optional<Whole> find_gap(const CyclicRing& turning, Whole near, const PlaneRay& at, Branches& branches) {
    Whole g = X_of(turning, near, at) <= at.x ? near : turning.held(near - 1);
    for (Whole look = 0; look < turning.N; ++look) {
        if (look == 1) branches.take(Branch::looks_twice);
        if (look == 2) branches.take(Branch::looks_thrice);
        if (turning.S(g) == 0) {
            branches.take(Branch::no_lines);
            return {};
        }
        if (at.x < X_of(turning, g, at)) {
            branches.take(Branch::gap_before);
            g = turning.held(g - 1);
        } else if (at.x >= X_of(turning, g + 1, at)) {
            branches.take(Branch::gap_behind);
            g = turning.held(g + 1);
        } else {
            return g;
        }
    }
    branches.take(Branch::not_found);
    return {};
}

Whole line_of(const CyclicRing& turning, Whole g, Whole m, Branches& branches) {
    const Whole first = turning.gap(g).first_line;
    if (m < 0) {
        const bool has_lines = turning.S(g - 1) > 0;
        branches.take(has_lines ? Branch::line_before : Branch::line_before_has_none);
        return has_lines ? turning.gap(g - 1).first_line + turning.S(g - 1) - 1 : first;
    }
    if (m >= turning.S(g)) {
        const bool has_lines = turning.S(g + 1) > 0;
        branches.take(has_lines ? Branch::line_behind : Branch::line_behind_has_none);
        return has_lines ? Whole{turning.gap(g + 1).first_line} : first + turning.S(g) - 1;
    }
    branches.take(Branch::line_between);
    return first + m;
}

// "Weight, and the cells around the ray"
void find_cells(const CyclicRing& turning, Whole g, const PlaneRay& at, ShapeRay& ray, Branches& branches) {
    const ShapeMap& shape = turning.ring.shape;
    const Whole f = at.x - X_of(turning, g, at);
    const Whole w = X_of(turning, g + 1, at) - X_of(turning, g, at);
    below(w, 30.6, "w");
    within(f, 0, w - 1, "f");
    const Whole S = within(turning.S(g), 1, 1024, "S");
    below(f * S, 40.6, "f * S");
    ray.weight = within(floor_div(below(512 * f + w, 40, "512 * f + w"), 2 * w), 0, 256, "weight");
    const Whole product = below((ray.p + shape.p_half_q20) * shape.p_cells_per_unit_q12, 45.1, "p's cell");
    const Whole P = below((product >> 24) - 128, 21.1, "P");
    const Whole L = below(floor_div(below(f * (256 * S), 48.6, "f * (256 * S)"), w) - 128, 18, "L");
    ray.p_part = (P >> 5) & 7;
    ray.line_part = (L >> 5) & 7;
    const std::array<Whole, 2> cell_p = {P >> 8, (P >> 8) + 1};
    const std::array<Whole, 2> m = {L >> 8, (L >> 8) + 1};
    for (const std::size_t n : {std::size_t{0}, std::size_t{1}}) {
        ray.cell_p[n] = clamp(cell_p[n], 0, shape.p_cells - 1);
        ray.line[n] = line_of(turning, g, m[n], branches);
    }
    ray.low = shape.depth_low_q20;
    ray.step = shape.depth_step_q24;
    ray.foot_d = clamp(floor_div(-128 * ray.low, ray.step), 0, 2040);
}

// "Everything linear in d."
ImageOfRay image_of_ray(const RaySpaceObject& object, const CyclicRing& turning, Whole g, std::size_t k,
                        const ShapeRay& ray) {
    ImageOfRay image;
    image.index = turning.ring.views[turning.index(g)];
    const CapturedLine& line = object.views[image.index].lines[k];
    const NormalLine& normal = turning.normal_line(g, k);
    const Whole l0 = line.l0_q20, l1 = line.l1_q30, l2 = normal.l2_q30;
    const Whole q0 = line.q0_q16, q1 = line.q1_q16, q2 = normal.q2_q16;
    const Whole cosine = ray.cosine, sine = ray.sine, low = ray.low, step = ray.step;
    const Whole xf = (ray.p * cosine) >> 30;
    const Whole zf = (ray.p * sine) >> 30;
    within(xf, 1 - kWidest_q20, kWidest_q20 - 1, "xf");
    within(zf, 1 - kWidest_q20, kWidest_q20 - 1, "zf");
    const Whole l_foot = l0 + (below(xf * l1 + zf * l2, 52.1, "xf * l1 + zf * l2") >> 30);
    below(l_foot, std::log2(std::exp2(28) + std::exp2(22.1)), "l_foot");
    const Whole l_along = at_most(at_most(sine * l1 - cosine * l2, 61, "sine * l1 - cosine * l2") >> 30, 31, "l_along");
    const Whole q_foot = q0 + (below(xf * q1 + zf * q2, 52.1, "xf * q1 + zf * q2") >> 20);
    below(q_foot, std::log2(std::exp2(31) + std::exp2(32.05)), "q_foot");
    const Whole q_along = at_most(at_most(sine * q1 - cosine * q2, 61, "sine * q1 - cosine * q2") >> 30, 31, "q_along");
    image.L0 = l_foot + (below(low * l_along, 52.1, "low * l_along") >> 30);
    below(image.L0, std::log2(std::exp2(28) + std::exp2(23.1)), "L0");
    image.L1 = at_most((step * l_along) >> 30, 19, "L1");
    image.Q0 = below((q_foot + (below(low * q_along, 52.1, "low * q_along") >> 20)) >> 4, 29.4, "Q0");
    image.Q1 = clamp((step * q_along) >> 28, -power(20), power(20));
    return image;
}

}  // namespace

std::optional<ShapeRay> shape_ray(const RaySpaceObject& object, const engine::ViewRegisters& view, const PlaneRay& at,
                                  Branches& branches) {
    const CyclicRing turning{object.rings[static_cast<std::size_t>(view.ring)]};
    const std::vector<std::uint16_t>& views = turning.ring.views;
    const Whole near = std::find(views.begin(), views.end(), at.image) - views.begin();
    ShapeRay ray;
    if (!find_vertical_plane(turning.ring.shape, view.planes[at.k], at, ray)) {
        branches.take(Branch::foot_too_far);
        return {};
    }
    if (const std::optional<Whole> g = find_gap(turning, near, at, branches)) {
        ray.has_shape = true;
        find_cells(turning, *g, at, ray, branches);
        ray.first = image_of_ray(object, turning, *g, at.k, ray);
        ray.second = image_of_ray(object, turning, *g + 1, at.k, ray);
    } else {
        ray.first = image_of_ray(object, turning, near, at.k, ray);
    }
    ray.lambda0 = ray.lambda_foot + floor_div(ray.low << 28, ray.r);
    below(ray.lambda0, std::log2(std::exp2(29) + std::exp2(25.1)), "lambda0");
    ray.lambda1 = at_most(floor_div(ray.step << 25, ray.r), 19, "lambda1");
    return ray;
}

}  // namespace rs::reference
