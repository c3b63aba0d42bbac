// engine/RECONSTRUCTION.md, sections 7 and 8.
#include "tests/reference/view/reference_shape.hpp"

#include <algorithm>

namespace rs::reference {
namespace {

struct Sum {
    Whole a = 0, r = 0, g = 0, b = 0, detail = 0;

    void add(const Sum& other, Whole weight) {
        a += weight * other.a;
        r += weight * other.r;
        g += weight * other.g;
        b += weight * other.b;
        detail += weight * other.detail;
    }
};

// Section 7, "Detail".
Whole detail_of(const PlanarImage& image, Whole W, Whole H, Whole i, Whole j, Branches& branches) {
    if (i == 0 || i == W - 1 || j == 0 || j == H - 1) {
        branches.take(Branch::no_detail_at_a_border);
        return 0;
    }
    const auto column = static_cast<int>(i), row = static_cast<int>(j);
    Whole laplacian = 4 * Whole{image.y(column, row)};
    bool is_opaque = image.a(column, row) == 255;
    for (const auto& [x, y] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        laplacian -= image.y(column + x, row + y);
        is_opaque = is_opaque && image.a(column + x, row + y) == 255;
    }
    if (!is_opaque) {
        branches.take(Branch::no_detail_beside_transparency);
        return 0;
    }
    const Whole D = (5 * laplacian + 8) >> 4;
    branches.take(D < -128 || D > 127 ? Branch::detail_clamped : Branch::detail);
    return clamp(D, -128, 127);
}

// Section 7; nullopt: outside.
std::optional<Sum> sample(const RaySpaceObject& object, const engine::ViewRegisters& view, const ImageOfRay& image,
                          Whole d, Whole y, Branches& branches) {
    const CapturedView& captured = object.views[image.index];
    const Whole W = object.width, H = object.height;
    const double kPlace = std::log2(std::exp2(22) + std::exp2(29));
    at_most(image.Q1, 20, "Q1");
    within(d, 0, 2040, "d");
    const Whole l = below(image.L0 + (below(d * image.L1, 30, "d * L1") >> 7), 28.1, "l");
    if (l < power(17)) {
        branches.take(Branch::too_near);
        return {};
    }
    const Whole inv = at_most(floor_div(power(40), l), 23, "inv");
    require(inv >= 3566, "inv", inv);  // 2^11.8 is 3565.8
    const Whole offset = below(image.Q0 + (below(d * image.Q1, 31, "d * Q1") >> 3), 30, "Q0 + (d * Q1 >> 3)");
    const Whole column =
        (captured.cx_q16 >> 8) + never_held(below(offset * inv, 53, "(Q0 + ...) * inv") >> 24, "column");
    const Whole unheld_m = below((captured.fl_y_q16 >> 8) * inv, 45, "(fl_y >> 8) * inv") >> 16;
    const Whole m = within(never_held(unheld_m, "m"), 0, power(29) - power(7), "m");
    const Whole height = captured.height_q20;
    const Whole product = below(m * (y - (height >> 4)), 57.5, "m * (y - (height >> 4))");
    const Whole row = (captured.cy_q16 >> 8) - hold(product >> 20);
    below(column, kPlace, "column");
    below(row, kPlace, "row");
    if (column < 0 || column >= W << 8 || row < 0 || row >= H << 8) {
        branches.take(Branch::beside_the_image);
        return {};
    }
    const Whole X = (column - 112) >> 5, fx = X & 7;
    const Whole left = std::max<Whole>(X >> 3, 0), right = std::min((X >> 3) + 1, W - 1);
    const Whole Z = (row - 112) >> 5, fz = Z & 7;
    const Whole top = std::max<Whole>(Z >> 3, 0), bottom = std::min((Z >> 3) + 1, H - 1);
    if (left == right || top == bottom) branches.take(Branch::at_a_border);
    Sum sum;
    const auto add = [&](Whole i, Whole j, Whole weight) {
        const Colour texel = stored_colour(object.images[image.index], i, j);
        sum.add({texel.A, texel.A * texel.R, texel.A * texel.G, texel.A * texel.B}, weight);
    };
    add(left, top, (8 - fx) * (8 - fz));
    add(left, bottom, (8 - fx) * fz);
    add(right, top, fx * (8 - fz));
    add(right, bottom, fx * fz);
    within(sum.a, 0, 64 * 255, "a of a sample");
    for (const Whole c : {sum.r, sum.g, sum.b}) within(c, 0, 64 * 255 * 255, "r, g, b of a sample");
    branches.take(sum.a == 0 ? Branch::transparent : Branch::seen);
    if (view.filter == engine::TexelFilter::kBilinear) {
        branches.take(Branch::bilinear);
        return sum;
    }
    const auto D = [&](Whole i, Whole j) { return detail_of(object.images[image.index], W, H, i, j, branches); };
    const Whole e = at_most((8 - fx) * (8 - fz) * D(left, top) + (8 - fx) * fz * D(left, bottom) +
                                fx * (8 - fz) * D(right, top) + fx * fz * D(right, bottom),
                            13, "e");
    const bool is_sharp = view.filter == engine::TexelFilter::kSharp;
    branches.take(is_sharp ? Branch::sharp : Branch::smooth);
    const Whole g = within(is_sharp ? fx * (8 - fx) + fz * (8 - fz) : Whole{-26}, -26, 32, "g");
    sum.detail = at_most((sum.a * (at_most(g * e, 18, "g * e") >> 6)) >> 6, 20, "detail of a sample");
    return sum;
}

struct Shown {
    Whole lambda = 0;
    Sum sum;
};

// "What a surface at depth d shows"
std::optional<Shown> shown_at(const RaySpaceObject& object, const engine::ViewRegisters& view, const ShapeRay& ray,
                              Whole rise, Whole d, Whole lean, Branches& branches) {
    Shown shown;
    shown.lambda = below(ray.lambda0 + (below(d * ray.lambda1, 30, "d * lambda1") >> 4), 29.3, "lambda");
    if (shown.lambda <= 0) {
        branches.take(Branch::behind_the_viewer);
        return {};
    }
    const Whole y = (view.b_q20 >> 4) + never_held(below(shown.lambda * rise, 56.3, "lambda * rise") >> 28, "y");
    below(y, std::log2(std::exp2(24) + std::exp2(28.3)), "y");
    const Whole weight = ray.weight;
    std::optional<Sum> s1, s2;
    if (weight < 256) s1 = sample(object, view, ray.first, d, y, branches);
    if (weight > 0) s2 = sample(object, view, ray.second, d, y, branches);
    if ((s1 && s1->a == 0) || (s2 && s2->a == 0)) {
        branches.take(Branch::transparent_hides);
        return {};
    }
    if (s1 && s2) {
        if (lean > 8) branches.take(Branch::leans_to_second);
        const Whole w = within(lean <= 8 ? (weight * lean + 4) >> 3 : weight + (((256 - weight) * (lean - 8) + 4) >> 3),
                               0, 256, "w");
        branches.take(Branch::both_images);
        shown.sum.add(*s1, 256 - w);
        shown.sum.add(*s2, w);
    } else if (s1 || s2) {
        branches.take(s1 ? Branch::first_image_alone : Branch::second_image_alone);
        shown.sum.add(s1 ? *s1 : *s2, 256);
    } else {
        branches.take(Branch::both_outside);
        return {};
    }
    return shown;
}

Whole alpha(const Shown& shown) {
    within(shown.sum.a, 1, 255 * power(14), "a of a sum");
    return (shown.sum.a + power(13)) >> 14;
}

// "The output"
ReferencePixel output(const std::optional<Shown>& shown, Branches& branches) {
    if (!shown) return {};
    const Sum& sum = shown->sum;
    const Whole A = alpha(*shown);
    if (A == 0) {
        branches.take(Branch::alpha_rounds_to_0);
        return {};
    }
    branches.take(Branch::shown);
    const auto divided = [&](Whole c) {
        within(c, 0, power(14) * 255 * 255, "r, g, b of a sum");
        const Whole sharp = below(c + at_most(sum.detail, 28, "detail of a sum"), 31, "c + detail");
        if (sharp < 0 || sharp > 255 * sum.a) branches.take(Branch::detail_leaves_the_codes);
        c = clamp(sharp, 0, 255 * sum.a);
        below(c + sum.a / 2, 30, "c + a / 2");
        return static_cast<std::uint8_t>(within(floor_div(c + floor_div(sum.a, 2), sum.a), 0, 255, "R, G, B"));
    };
    return {divided(sum.r), divided(sum.g), divided(sum.b), static_cast<std::uint8_t>(A),
            static_cast<std::int32_t>(shown->lambda)};
}

// "Over"
ReferencePixel over(const ReferencePixel& n, const ReferencePixel& f, Branches& branches) {
    const Whole w = within(n.A + (n.A >> 7), 1, 256, "w");
    const auto mixed = [&](Whole of_n, Whole of_f) {
        const Whole sum = below(of_n * w + of_f * (256 - w) + 128, 16, "n * w + f * (256 - w) + 128");
        return static_cast<std::uint8_t>(within(sum >> 8, 0, 255, "R, G, B, A over another"));
    };
    branches.take(n.A >= 128 ? Branch::over_and_nearer : Branch::over_and_farther);
    return {mixed(n.R, f.R), mixed(n.G, f.G), mixed(n.B, f.B), mixed(255, f.A),
            n.A >= 128 ? n.lambda_q20 : f.lambda_q20};
}

}  // namespace

ReferencePixel pixel_with_shape(const RaySpaceObject& object, const engine::ViewRegisters& view, int i, int j,
                                const PlaneRay& plane_ray, Branches& branches) {
    const std::optional<ShapeRay> ray = shape_ray(object, view, plane_ray, branches);
    if (!ray) return {};
    const engine::LinearForm& s = view.rise;
    const Whole rise = below((Whole{s.at_origin} + Whole{i} * s.per_column + Whole{j} * s.per_row) >> 8, 27, "rise");
    const auto shows = [&](Whole d, Whole lean) { return shown_at(object, view, *ray, rise, d, lean, branches); };
    if (!ray->has_shape) {
        branches.take(Branch::no_shape);
        return output(shows(0, 8), branches);
    }
    const ShapeMap& shape = object.rings[static_cast<std::size_t>(view.ring)].shape;
    std::optional<Shown> shown;
    int met = 0;
    if (ray->weight == 0 || ray->weight == 256) {
        branches.take(ray->weight == 0 ? Branch::weight_is_0 : Branch::weight_is_256);
        const auto first_met = [&](Whole d, Whole lean, bool) {
            shown = shows(d, lean);
            return ++met > 0;
        };
        march(shape, view, *ray, rise, first_met, branches);
        if (met == 0) {
            branches.take(Branch::on_line_without_surface);
            shown = shows(ray->foot_d, 8);
        }
        return output(shown, branches);
    }
    branches.take(Branch::blended);
    std::optional<ReferencePixel> pixel;
    const auto will_do = [&](Whole d, Whole lean, bool at_end) {
        if (++met == 2) branches.take(Branch::met_after_another);
        const std::optional<Shown> of_this = shows(d, lean);
        if (!of_this) return false;
        const ReferencePixel here = output(of_this, branches);
        const bool covers = here.A >= 230;
        if (!at_end || (!pixel && here.A > 0)) {
            pixel = here;
        } else if (pixel && covers) {
            pixel = over(*pixel, here, branches);
        } else {
            branches.take(pixel ? Branch::over_what_does_not_cover : Branch::over_nothing);
        }
        return !at_end || covers;
    };
    march(shape, view, *ray, rise, will_do, branches);
    if (!pixel) branches.take(Branch::none_shows_something);
    return pixel.value_or(ReferencePixel{});
}

}  // namespace rs::reference
