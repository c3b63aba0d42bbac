#pragma once
// Sections 6 to 8 of engine/RECONSTRUCTION.md: computes the pixel of a view ray from its set_up_shape(). Readable
// definition; shape_walk.hpp is the SIMD implementation.

#include "engine/core/definition/cell_march.hpp"
#include "engine/core/definition/fixed_point.hpp"
#include "engine/core/definition/shape_setup.hpp"
#include "engine/core/definition/texel_detail.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <algorithm>
#include <cstdint>

namespace rs::engine {

struct ShapePixel {
    Rgba8 colour;
    std::int32_t lambda_q20 = 0;  // axial depth in the view, object radii; only where colour.a > 0
};

// A surface with less alpha does not cover its pixel: at the end of a march the surfaces behind it are blended, too.
inline constexpr int kCoveringAlpha = 230;
inline constexpr std::int32_t kNearest_q20 = 1 << 17;  // least axial depth in a captured image

// Bilinear sample: sums over four texels of weight * alpha (weights add up to 64) and of weight * alpha * colour.
struct SampleSum {
    bool exists = false;  // the point projects into the image
    std::int32_t a = 0, r = 0, g = 0, b = 0;
    std::int32_t detail = 0;  // added to r, g and b by resolve(); 0 with the bilinear filter
};

inline SampleSum mix(const SampleSum& first, const SampleSum& second, int weight) {
    const auto of = [&](int a, int b) { return a * (256 - weight) + b * weight; };
    return {true,
            of(first.a, second.a),
            of(first.r, second.r),
            of(first.g, second.g),
            of(first.b, second.b),
            of(first.detail, second.detail)};
}

inline Rgba8 resolve(const SampleSum& sum) {
    const int alpha = (sum.a + (1 << 13)) >> 14;
    if (alpha == 0) return {};
    const auto channel = [&](int c) {
        return static_cast<std::uint8_t>((std::clamp(c + sum.detail, 0, 255 * sum.a) + sum.a / 2) / sum.a);
    };
    return {channel(sum.r), channel(sum.g), channel(sum.b), static_cast<std::uint8_t>(alpha)};
}

// Section 7. `texels.color(view, column, row)` returns a stored pixel as Rgba8, `texels.detail(view, column, row)` its
// texel_detail_at().
template <class Texels>
SampleSum sample_image(const RaySpaceObject& object, const ShapeImage& image, int d_q3, std::int32_t y_q16,
                       TexelFilter filter, const Texels& texels) {
    const CapturedView& view = object.views[static_cast<std::size_t>(image.view)];
    const std::int32_t l_q20 = image.l0_q20 + ((d_q3 * image.l1_q24) >> 7);
    if (l_q20 < kNearest_q20) return {};
    const auto inverse_q20 = static_cast<std::int32_t>((std::int64_t{1} << 40) / l_q20);
    const std::int32_t n_q12 = image.n0_q12 + ((d_q3 * image.n1_q12) >> 3);
    const std::int32_t column_q8 = (view.cx_q16 >> 8) + multiply_shift(n_q12, inverse_q20, 24);
    const std::int32_t m_q12 = multiply_shift(view.fl_y_q16 >> 8, inverse_q20, 16);
    const std::int32_t row_q8 = (view.cy_q16 >> 8) - multiply_shift(m_q12, y_q16 - (view.height_q20 >> 4), 20);
    if (column_q8 < 0 || column_q8 >= object.width << 8 || row_q8 < 0 || row_q8 >= object.height << 8) return {};

    // Position of the sample in eighths of a pixel, from the centre of pixel (0, 0).
    const int x_q3 = (column_q8 - 128 + 16) >> 5;
    const int y_q3 = (row_q8 - 128 + 16) >> 5;
    const int left = std::max(x_q3 >> 3, 0);
    const int right = std::min((x_q3 >> 3) + 1, object.width - 1);
    const int top = std::max(y_q3 >> 3, 0);
    const int bottom = std::min((y_q3 >> 3) + 1, object.height - 1);
    SampleSum sum{true};
    const auto add = [&](int column, int row, int weight) {
        const Rgba8 t = texels.color(image.view, column, row);
        sum.a += weight * t.a;
        sum.r += weight * t.a * t.r;
        sum.g += weight * t.a * t.g;
        sum.b += weight * t.a * t.b;
    };
    const int fx = x_q3 & 7;
    const int fy = y_q3 & 7;
    add(left, top, (8 - fx) * (8 - fy));
    add(left, bottom, (8 - fx) * fy);
    add(right, top, fx * (8 - fy));
    add(right, bottom, fx * fy);
    if (filter == TexelFilter::kBilinear) return sum;

    const auto detail = [&](int column, int row) { return texels.detail(image.view, column, row); };
    const int detail_sum = (8 - fx) * (8 - fy) * detail(left, top) + (8 - fx) * fy * detail(left, bottom) +
                           fx * (8 - fy) * detail(right, top) + fx * fy * detail(right, bottom);
    sum.detail = sample_detail(filter, fx, fy, sum.a, detail_sum);
    return sum;
}

// Section 8: blend weight of the second image, 0..256, adjusted by the lean (visibility weight) of a surface.
inline int apply_lean(int weight, int lean) {
    if (lean <= kBothShow) return (weight * lean + 4) >> 3;
    return weight + (((256 - weight) * (lean - kBothShow) + 4) >> 3);
}

// Section 8: blend of both images at a surface.
struct BlendedSurface {
    SampleSum sum;  // weights add up to 64 * 256; does not exist, or a = 0, if neither image shows the surface
    std::int32_t lambda_q20 = 0;
};

// Blends both images at a surface's depth. `rise_q24`: the rise of the pixel's direction (ViewRegisters::rise_q24).
template <class Texels>
BlendedSurface blend_surface(const RaySpaceObject& object, const ViewRegisters& registers, const ShapeSetup& setup,
                             const SurfaceCell& surface, std::int32_t rise_q24, const Texels& texels) {
    BlendedSurface shown;
    shown.lambda_q20 = setup.lambda0_q20 + ((surface.depth_q3 * setup.lambda1_q21) >> 4);
    if (shown.lambda_q20 <= 0) return {};
    const std::int32_t y_q16 = (registers.b_q20 >> 4) + multiply_shift(shown.lambda_q20, rise_q24, 28);
    const auto sample = [&](const ShapeImage& image) {
        return sample_image(object, image, surface.depth_q3, y_q16, registers.filter, texels);
    };
    const SampleSum first = setup.weight < 256 ? sample(setup.first) : SampleSum{};
    const SampleSum second = setup.weight > 0 ? sample(setup.second) : SampleSum{};
    // Every point of the object projects into every silhouette.
    if ((first.exists && first.a == 0) || (second.exists && second.a == 0)) return {};
    if (first.exists && second.exists) shown.sum = mix(first, second, apply_lean(setup.weight, surface.lean));
    if (first.exists != second.exists) shown.sum = first.exists ? mix(first, first, 0) : mix(second, second, 0);
    return shown;
}

// Section 8, "Over": composites a surface over a farther one, if the farther one covers its pixel.
inline ShapePixel blend_over(const ShapePixel& nearer, const ShapePixel& farther) {
    const Rgba8& n = nearer.colour;
    const Rgba8& f = farther.colour;
    if (n.a == 0) return farther;
    if (f.a < kCoveringAlpha) return nearer;
    const int weight = n.a + (n.a >> 7);  // of the nearer surface, 1/256
    const auto mixed = [&](int of_n, int of_f) {
        return static_cast<std::uint8_t>((of_n * weight + of_f * (256 - weight) + 128) >> 8);
    };
    return {{mixed(n.r, f.r), mixed(n.g, f.g), mixed(n.b, f.b), mixed(255, f.a)},
            n.a < 128 ? farther.lambda_q20 : nearer.lambda_q20};
}

template <class Texels>
ShapePixel shape_pixel(const RaySpaceObject& object, const ViewRegisters& registers, const ShapeSetup& setup,
                       std::int32_t rise_q24, const Texels& texels) {
    const auto shown_at = [&](const SurfaceCell& surface) {
        return blend_surface(object, registers, setup, surface, rise_q24, texels);
    };
    const auto pixel = [](const BlendedSurface& shown) { return ShapePixel{resolve(shown.sum), shown.lambda_q20}; };
    if (!setup.has_shape()) return pixel(shown_at({.depth_q3 = 0}));

    const ShapeMap& shape = object.rings[static_cast<std::size_t>(registers.ring)].shape;
    CellMarch march(shape, setup, registers.b_q20, rise_q24);
    SurfaceCell cell = march.next();
    if (setup.weight == 0 || setup.weight == 256) {
        // On a captured line only that image is sampled, independently of the depth.
        return pixel(shown_at({.depth_q3 = cell.exists() ? cell.depth_q3 : setup.foot_depth_q3}));
    }
    ShapePixel nearer;  // first visible surface, which does not cover the pixel
    for (; cell.exists(); cell = march.next()) {
        const BlendedSurface shown = shown_at(cell);
        if (shown.sum.a == 0) continue;
        const ShapePixel here = pixel(shown);
        nearer = blend_over(nearer, here);
        if (!march.at_end() || here.colour.a >= kCoveringAlpha) break;
    }
    return nearer;
}

}  // namespace rs::engine
