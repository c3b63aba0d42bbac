#include "tests/reference/view/reference_view.hpp"

#include "tests/reference/view/reference_shape.hpp"

namespace rs::reference {
namespace {

// Sections 3 and 4.
ReferencePixel pixel_on_plane(const RaySpaceObject& object, const engine::ViewRegisters& view, int i, int j,
                              const PlaneRay& ray, Branches& branches) {
    const CapturedView& captured = object.views[ray.image];
    const CapturedLine& line = captured.lines[ray.k];
    const auto no_ray = [&](Branch why) {
        branches.take(why);
        return ReferencePixel{};
    };
    const Whole x = ray.x;
    const Whole l = line.l0_q20 + ((x * line.l1_q30) >> 30);
    if (l < power(17)) return no_ray(Branch::too_near_on_plane);
    const Whole dividend = in_bits((line.q0_q16 + ((x * line.q1_q16) >> 20)) << 20, 54, "(q0 + x q1) << 20");
    const Whole q = captured.cx_q16 + floor_div(dividend, l);
    const Whole column = q >> 16;
    if (column < 0 || column >= object.width) return no_ray(Branch::outside_on_plane);
    const Whole m = floor_div(Whole{captured.fl_y_q16} << 20, l);
    if (m >= power(30)) return no_ray(Branch::too_large_on_plane);
    const Whole S = below((Whole{view.rise.at_origin} + Whole{i} * view.rise.per_column) >> 4, 31, "S");
    const Whole sy = below(view.rise.per_row, 33, "sy");
    const Whole Y = view.b_q20 + (in_bits(ray.lambda * S, 61, "lambda * S") >> 28);
    const Whole step_Y = in_bits(ray.lambda * sy, 63, "lambda * sy") >> 28;
    if (step_Y < -power(28) || step_Y > power(28)) return no_ray(Branch::too_steep_on_plane);
    const Whole row_0 = captured.cy_q16 - (in_bits(m * (Y - captured.height_q20), 64, "m * (Y - height)") >> 20);
    const Whole step = -(in_bits(m * step_Y, 60, "m * step_Y") >> 24);
    const Whole row = (row_0 + j * step) >> 16;
    if (row < 0 || row >= object.height) return no_ray(Branch::outside_on_plane);

    const Colour colour = stored_colour(object.images[ray.image], column, row);
    branches.take(Branch::shown_on_plane);
    if (colour.A == 0) return {};
    return {static_cast<std::uint8_t>(colour.R), static_cast<std::uint8_t>(colour.G),
            static_cast<std::uint8_t>(colour.B), static_cast<std::uint8_t>(colour.A),
            static_cast<std::int32_t>(ray.lambda)};
}

}  // namespace

std::optional<PlaneRay> plane_ray(const RaySpaceObject& object, const engine::ViewRegisters& view, int i, int j,
                                  Branches& branches) {
    const Ring& ring = object.rings[static_cast<std::size_t>(view.ring)];
    const auto at_pixel = [&](const engine::LinearForm& form) {
        return below((Whole{form.at_origin} + Whole{i} * form.per_column + Whole{j} * form.per_row) >> 4, 31, "N, T");
    };
    PlaneRay ray;
    Whole smallest_N = 0;
    for (std::size_t k = 0; k < view.planes.size(); ++k) {
        const Whole N = at_pixel(view.planes[k].along_normal);
        if (k == 0 || N < smallest_N) {
            smallest_N = N;
            ray.k = k;
        }
    }
    const std::size_t k = ray.k;
    const Whole n = ray.n = -smallest_N;
    const Whole T = ray.T = at_pixel(view.planes[k].along_tangent);
    const Whole a = below(view.planes[k].a_q20, 28, "a");
    const Whole c = below(view.planes[k].c_q20, 28, "c");
    below(view.b_q20, 28, "b");
    if (c <= 0 || n < power(24)) {
        branches.take(Branch::plane_behind_or_edge_on);
        return {};
    }
    const Whole u = ray.u = below(floor_div(in_bits(T << 28, 60, "T << 28"), n), 29, "u");
    const Whole x = ray.x = a + (in_bits(u * c, 58, "u * c") >> 28);
    const Whole lambda = ray.lambda = floor_div(in_bits(c << 28, 57, "c << 28"), n);
    const Whole x_half = ring.x_half_q20;
    if (x < -x_half || x >= x_half || lambda >= power(29)) {
        branches.take(Branch::misses_or_too_far);
        return {};
    }
    require(x > -(power(21) + power(16)) && x < power(21) + power(16), "x", x);
    const Whole xi = clamp(((x + x_half) * ring.x_cells_per_unit_q12) >> 32, 0, ring.x_cells - 1);
    const Whole ui = clamp(((u + ring.u_half_q28) * ring.u_cells_per_unit_q12) >> 40, 0, ring.u_cells - 1);
    ray.image = ring.cells[static_cast<std::size_t>((static_cast<Whole>(k) * ring.x_cells + xi) * ring.u_cells + ui)];
    if (ray.image == 65535) {
        branches.take(Branch::no_image);
        return {};
    }
    return ray;
}

Colour stored_colour(const PlanarImage& image, Whole column_of_image, Whole row_of_image) {
    const int column = static_cast<int>(column_of_image);
    const int row = static_cast<int>(row_of_image);
    const int shift = image.chroma_shift;
    const Whole Y = image.y(column, row);
    const Whole A = image.a(column, row);
    const Whole U = image.u(column >> shift, row >> shift);
    const Whole V = image.v(column >> shift, row >> shift);
    if (A == 0) return {};
    const Whole base = (Y << 16) + 32768;
    return {clamp((base + 91881 * (V - 128)) >> 16, 0, 255),
            clamp((base - 22554 * (U - 128) - 46802 * (V - 128)) >> 16, 0, 255),
            clamp((base + 116130 * (U - 128)) >> 16, 0, 255), A};
}

ReferencePixel reference_pixel(const RaySpaceObject& object, const engine::ViewRegisters& view, int i, int j,
                               Branches& branches) {
    const std::optional<PlaneRay> ray = plane_ray(object, view, i, j, branches);
    if (!ray) return {};
    if (object.rings[static_cast<std::size_t>(view.ring)].shape.empty()) {
        return pixel_on_plane(object, view, i, j, *ray, branches);
    }
    return pixel_with_shape(object, view, i, j, *ray, branches);
}

}  // namespace rs::reference
