// SIMD implementation of blend_surface() and laid_over() of shape_pixel.hpp, one row of the column per lane. No include
// guard: shape_walk.cpp includes it once for each SIMD target.

#include "engine/core/definition/shape_pixel.hpp"
#include "engine/core/fast/cell_march_lanes.inl"

HWY_BEFORE_NAMESPACE();
namespace rs::engine::HWY_NAMESPACE {

// Image position of the sample of each lane, eighths of a pixel from the centre of pixel (0, 0).
struct SamplePosition {
    LaneMask exists;
    Vector x_q3;
    Vector y_q3;
};

// First part of sample_image(), before the texels are read, for the lanes `requested`.
HWY_INLINE SamplePosition sample_position(const ShapeWalk& walk, const ShapeImageColumn& image, Vector d, Vector y_q16,
                                          LaneMask requested) {
    const Vector l = hn::Add(number(image.l0_q20), hn::ShiftRight<7>(hn::Mul(d, number(image.l1_q24))));
    const Vector inverse_l = inverse(l);
    const Vector n = hn::Add(number(image.n0_q12), hn::ShiftRight<3>(hn::Mul(d, number(image.n1_q12))));
    const Vector column = hn::Add(number(image.cx_q8), multiply_shift_within<24>(n, inverse_l));
    const Vector m = multiply_shift_within<16>(number(image.fl_y_q8), inverse_l);
    const Vector row = hn::Sub(number(image.cy_q8), multiply_shift<20>(m, hn::Sub(y_q16, number(image.height_q16))));
    SamplePosition position;
    position.exists = hn::And(hn::And(requested, hn::Gt(l, number(kNearest_q20 - 1))),
                              hn::And(within(column, walk.width << 8), within(row, walk.height << 8)));
    position.x_q3 = hn::ShiftRight<5>(hn::Sub(column, number(128 - 16)));
    position.y_q3 = hn::ShiftRight<5>(hn::Sub(row, number(128 - 16)));
    return position;
}

struct Sample {
    TexelWeights weights;
    TexelQuads texels;
    Vector detail;  // codes, q6; 0 with the bilinear filter
};

// Sample positions of a surface in both images.
struct SurfacePositions {
    Vector lambda_q20;
    SamplePosition first;
    SamplePosition second;
};

HWY_INLINE SurfacePositions surface_positions(const ShapeWalk& walk, const ShapeColumn& column, Vector rise, Vector d,
                                              LaneMask requested) {
    SurfacePositions positions;
    positions.lambda_q20 =
        hn::Add(number(column.lambda0_q20), hn::ShiftRight<4>(hn::Mul(d, number(column.lambda1_q21))));
    const LaneMask in_front = hn::And(requested, hn::Gt(positions.lambda_q20, hn::Zero(Lanes())));
    const Vector y_q16 = hn::Add(number(walk.b_q16), multiply_shift_within<28>(positions.lambda_q20, rise));
    const auto in_image = [&](const ShapeImageColumn& image) {
        return sample_position(walk, image, d, y_q16, image.used ? in_front : none());
    };
    positions.first = in_image(column.first);
    positions.second = in_image(column.second);
    return positions;
}

struct BlendedLanes {
    LaneMask shown;
    Vector colour;
};

// leaning_weight() of the lanes `requested`.
HWY_INLINE Vector weight_of_second(const ShapeColumn& column, Vector surface, LaneMask requested) {
    const Vector lean = hn::ShiftRight<kDepthBits>(surface);
    const Vector both = number(kBothShow);
    const Vector weight = number(column.weight);
    if (HWY_LIKELY(hn::AllTrue(Lanes(), hn::Or(hn::Not(requested), hn::Eq(lean, both))))) return weight;
    const auto share = [](Vector of, Vector eighths) {
        return hn::ShiftRight<3>(hn::Add(hn::Mul(of, eighths), number(4)));
    };
    const Vector to_second = hn::Add(weight, share(hn::Sub(number(256), weight), hn::Sub(lean, both)));
    return hn::IfThenElse(hn::Gt(lean, both), to_second, share(weight, lean));
}

// resolve(mix()) if every texel of both images is opaque: a mean of eight texels whose weights add up to 64 * 256.
HWY_INLINE Vector opaque_colour(const Sample& first, const Sample& second, Vector weight, bool has_detail) {
    const Vector half = number(1 << 13);
    Channels sum{half, half, half, half};
    const auto add = [&](const Sample& sample, Vector share) {  // 1/256, in both 16-bit halves
        add_texels(sample.texels,
                   {multiply_halves(sample.weights.upper, share), multiply_halves(sample.weights.lower, share)}, sum);
    };
    const Vector share = hn::Mul(weight, number(0x10001));
    add(first, hn::Sub(number(256 * 0x10001), share));
    add(second, share);
    if (has_detail) {
        // The weights of the sums add up to 64 * 256, those of the details to 64.
        const Vector detail =
            hn::Add(hn::ShiftLeft<8>(first.detail), hn::Mul(hn::Sub(second.detail, first.detail), weight));
        const auto add_detail = [&](Vector& c) {
            c = hn::Min(hn::Max(hn::Add(c, detail), half), number((255 << 14) + (1 << 13)));
        };
        add_detail(sum.r);
        add_detail(sum.g);
        add_detail(sum.b);
    }
    return packed(hn::ShiftRight<14>(sum.r), hn::ShiftRight<14>(sum.g), hn::ShiftRight<14>(sum.b), number(255));
}

// blend_surface() of `surface_met` in the lanes `requested`.
HWY_INLINE BlendedLanes blend_surface_lanes(const ShapeWalk& walk, const ShapeColumn& column,
                                            const SurfacePositions& positions, Vector surface_met, LaneMask requested) {
    const Vector zero = hn::Zero(Lanes());
    // The border of the texels replaces the clamps of section 7.
    const TexelGrid grid{reinterpret_cast<const std::int32_t*>(walk.texels), walk.details, walk.column_stride,
                         walk.height};
    const bool has_detail = walk.details != nullptr;
    const auto sample = [&](const SamplePosition& at, const ShapeImageColumn& image) {
        const Vector x = hn::And(at.x_q3, number(7));
        const Vector y = hn::And(at.y_q3, number(7));
        Sample taken{texel_weights(x, y), fetch(grid, image.start, at.x_q3, at.y_q3, at.exists), zero};
        if (has_detail) taken.detail = detail_codes(walk.filter, taken.texels, taken.weights, x, y);
        return taken;
    };
    const LaneMask first_exists = positions.first.exists;
    const LaneMask second_exists = positions.second.exists;
    const Sample first = sample(positions.first, column.first);
    const Sample second = sample(positions.second, column.second);
    BlendedLanes surface;
    const LaneMask both = hn::And(first_exists, second_exists);
    const Vector alphas = hn::Or(hn::And(all_bits(first.texels), all_bits(second.texels)), number(0x00FFFFFF));
    if (HWY_LIKELY(hn::AllTrue(Lanes(), hn::Or(hn::Not(requested), hn::And(both, hn::Eq(alphas, number(-1))))))) {
        surface.shown = both;
        surface.colour = opaque_colour(first, second, weight_of_second(column, surface_met, requested), has_detail);
        return surface;
    }

    const Channels first_sum = premultiplied(first.texels, first.weights);
    const Channels second_sum = premultiplied(second.texels, second.weights);
    const LaneMask transparent =
        hn::Or(hn::And(first_exists, hn::Eq(first_sum.a, zero)), hn::And(second_exists, hn::Eq(second_sum.a, zero)));
    surface.shown = hn::AndNot(transparent, hn::Or(first_exists, second_exists));
    const Vector weight = hn::IfThenElse(both, weight_of_second(column, surface_met, requested),
                                         hn::IfThenZeroElse(first_exists, number(256)));
    const auto mixed = [&](Vector f, Vector s) { return hn::Add(hn::ShiftLeft<8>(f), hn::Mul(hn::Sub(s, f), weight)); };
    const auto detail = [](const Channels& sum, const Sample& of) {
        return hn::ShiftRight<6>(hn::Mul(sum.a, of.detail));
    };
    surface.colour = resolve_lanes({mixed(first_sum.r, second_sum.r), mixed(first_sum.g, second_sum.g),
                                    mixed(first_sum.b, second_sum.b), mixed(first_sum.a, second_sum.a)},
                                   mixed(detail(first_sum, first), detail(second_sum, second)));
    return surface;
}

HWY_INLINE Vector alpha_of(Vector colour) {
    const hn::RebindToUnsigned<Lanes> bits;
    return hn::BitCast(Lanes(), hn::ShiftRight<24>(hn::BitCast(bits, colour)));
}

// laid_over() of two visible surfaces of which the farther one covers its pixel. Computes two channels at once.
HWY_INLINE Vector laid_over(Vector nearer, Vector farther) {
    const Vector two = number(0x00FF00FF);
    const Vector alpha = alpha_of(nearer);
    const Vector weight = hn::Add(alpha, hn::ShiftRight<7>(alpha));
    const auto mixed = [&](Vector n, Vector f) {
        const Vector sum =
            hn::Add(hn::Mul(hn::And(n, two), weight), hn::Mul(hn::And(f, two), hn::Sub(number(256), weight)));
        return hn::Add(sum, number(0x00800080));
    };
    const Vector opaque = hn::Or(nearer, number(-0x01000000));
    const Vector red_blue = mixed(opaque, farther);
    const Vector green_alpha = mixed(hn::ShiftRight<8>(opaque), hn::ShiftRight<8>(farther));
    return hn::Or(hn::And(hn::ShiftRight<8>(red_blue), two), hn::AndNot(two, green_alpha));
}

}  // namespace rs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
