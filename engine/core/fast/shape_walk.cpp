#include "engine/core/fast/shape_walk.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/core/fast/shape_walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/core/definition/shape_pixel.hpp"

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

#include "engine/core/fast/cell_march_lanes.inl"

HWY_BEFORE_NAMESPACE();
namespace rs::engine::HWY_NAMESPACE {

// Where a sample of each lane falls, and the texels there.
struct SamplePlace {
    LaneMask exists;
    TexelWeights weights;
    TexelQuads texels;
};

// sample_picture() of the lanes `wanted`, as far as the texels.
HWY_INLINE SamplePlace sample_place(const ShapeWalk& walk, const ShapePictureLanes& picture, int lane, Vector d,
                                    Vector y_q16, LaneMask wanted) {
    const auto load = [&](const std::int32_t* lanes) { return hn::Load(Lanes(), lanes + lane); };
    const Vector l = hn::Add(load(picture.l0_q20), hn::ShiftRight<7>(hn::Mul(d, load(picture.l1_q24))));
    const Vector inverse_l = inverse(l);
    const Vector n = hn::Add(load(picture.n0_q12), hn::ShiftRight<3>(hn::Mul(d, load(picture.n1_q12))));
    const Vector column = hn::Add(load(picture.cx_q8), multiply_shift_within<24>(n, inverse_l));
    const Vector m = multiply_shift_within<16>(load(picture.fl_y_q8), inverse_l);
    const Vector row = hn::Sub(load(picture.cy_q8), multiply_shift<20>(m, hn::Sub(y_q16, load(picture.height_q16))));
    SamplePlace place;
    place.exists = hn::And(hn::And(wanted, at_least(l, number(kNearest_q20))),
                           hn::And(within(column, number(walk.width_q8)), within(row, number(walk.height_q8))));

    // The texels' border stands in for the clamps.
    const Vector x = hn::ShiftRight<5>(hn::Sub(column, number(128 - 16)));
    const Vector y = hn::ShiftRight<5>(hn::Sub(row, number(128 - 16)));
    const Vector index =
        hn::IfThenElseZero(place.exists, hn::Add(hn::Add(load(picture.start), hn::ShiftRight<3>(y)),
                                                 hn::Mul(hn::ShiftRight<3>(x), number(walk.column_stride))));
    alignas(64) std::int32_t indices[kStripColumns];
    hn::Store(index, Lanes(), indices);
    place.weights = texel_weights(hn::And(x, number(7)), hn::And(y, number(7)));
    place.texels = fetch(reinterpret_cast<const std::int32_t*>(walk.texels), walk.column_stride, indices);
    return place;
}

struct ShownLanes {
    LaneMask shown;
    Vector colour;
    Vector lambda_q20;
};

// Inside of the object: where every texel of both pictures is opaque, resolve(mix()) is a mean of eight texels whose
// weights are 64 * 256 together.
HWY_INLINE Vector opaque_colour(const ShapeStrip& strip, int lane, const SamplePlace& first,
                                const SamplePlace& second) {
    Channels sum;
    for (Vector& channel : sum.of) channel = number(1 << 13);
    const auto add = [&](const SamplePlace& place, const ShapePictureLanes& picture) {
        const Vector share = hn::Load(Lanes(), picture.share + lane);
        add_texels(place.texels,
                   {multiply_halves(place.weights.upper, share), multiply_halves(place.weights.lower, share)}, sum);
    };
    add(first, strip.first);
    add(second, strip.second);
    for (Vector& channel : sum.of) channel = hn::ShiftRight<14>(channel);
    return packed(sum);
}

// shown_surface() of the lanes `wanted`, at depth `d`.
HWY_INLINE ShownLanes shown_lanes(const ShapeWalk& walk, const ShapeStrip& strip, int lane, Vector rise, Vector d,
                                  LaneMask wanted) {
    const auto load = [&](const std::int32_t* lanes) { return hn::Load(Lanes(), lanes + lane); };
    const auto used = [&](const ShapePictureLanes& picture) { return hn::MaskFromVec(load(picture.used)); };
    const Vector zero = hn::Zero(Lanes());
    ShownLanes surface;
    surface.lambda_q20 = hn::Add(load(strip.lambda0_q20), hn::ShiftRight<4>(hn::Mul(d, load(strip.lambda1_q21))));
    const LaneMask looked_at = hn::And(wanted, hn::Gt(surface.lambda_q20, zero));
    const Vector y_q16 = hn::Add(number(walk.b_q16), multiply_shift_within<28>(surface.lambda_q20, rise));
    const SamplePlace first = sample_place(walk, strip.first, lane, d, y_q16, hn::And(looked_at, used(strip.first)));
    const SamplePlace second = sample_place(walk, strip.second, lane, d, y_q16, hn::And(looked_at, used(strip.second)));
    const LaneMask both = hn::And(first.exists, second.exists);
    const Vector alphas = hn::Or(hn::And(all_bits(first.texels), all_bits(second.texels)), number(0x00FFFFFF));
    if (HWY_LIKELY(hn::AllTrue(Lanes(), hn::And(both, hn::Eq(alphas, number(-1)))))) {
        surface.shown = both;
        surface.colour = opaque_colour(strip, lane, first, second);
        return surface;
    }

    const Channels first_sum = premultiplied(first.texels, first.weights);
    const Channels second_sum = premultiplied(second.texels, second.weights);
    const Vector first_a = fourth(first_sum);
    const Vector second_a = fourth(second_sum);
    const LaneMask transparent =
        hn::Or(hn::And(first.exists, hn::Eq(first_a, zero)), hn::And(second.exists, hn::Eq(second_a, zero)));
    surface.shown = hn::AndNot(transparent, hn::Or(first.exists, second.exists));
    const Vector weight = hn::IfThenElse(both, load(strip.weight), hn::IfThenZeroElse(first.exists, number(256)));
    const auto mixed = [](Vector f, Vector s, Vector w) {
        return hn::Add(hn::ShiftLeft<8>(f), hn::Mul(hn::Sub(s, f), w));
    };
    const Channels sum =
        for_channels(weight, [&](int n, Vector w) { return mixed(first_sum.of[n], second_sum.of[n], w); });
    surface.colour = resolve_lanes(sum, mixed(first_a, second_a, weight));
    return surface;
}

HWY_INLINE Vector alpha_of(Vector colour) {
    const hn::RebindToUnsigned<Lanes> bits;
    return hn::BitCast(Lanes(), hn::ShiftRight<24>(hn::BitCast(bits, colour)));
}

// laid_over() of colours where both surfaces show something and the farther one covers its pixel. Two channels at once.
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

// Of the lanes whose `asking` is -1, not 0, what lies behind the last surface, with `colour`, which is that surface's,
// laid over it. A function of its own, since few vectors come here: what it needs would take registers from all others.
HWY_NOINLINE void walk_behind(const ShapeWalk& walk, const ShapeStrip& strip, int lane, std::int32_t rise_q24,
                              const std::int32_t* asking, std::int32_t* colour, std::int32_t* lambda) {
    const Vector zero = hn::Zero(Lanes());
    const Vector rise = number(rise_q24);
    LaneMask wanted = hn::MaskFromVec(hn::Load(Lanes(), asking));
    const auto surfaces = MarchLanes(walk, strip, lane, rise).still_to_come(wanted);
    for (const Vector depth : {surfaces.behind, surfaces.farthest}) {
        const LaneMask looking = hn::And(wanted, is_surface(depth));
        if (hn::AllFalse(Lanes(), looking)) continue;
        const ShownLanes surface = shown_lanes(walk, strip, lane, rise, depth, looking);
        const Vector nearer = hn::LoadU(Lanes(), colour);
        const Vector farther = hn::IfThenElseZero(surface.shown, surface.colour);
        const LaneMask alone = hn::And(looking, hn::Eq(nearer, zero));
        const LaneMask covers = hn::And(looking, at_least(alpha_of(farther), number(kCoveringAlpha)));
        const Vector over = hn::IfThenElse(covers, laid_over(nearer, farther), nearer);
        hn::StoreU(hn::IfThenElse(alone, farther, over), Lanes(), colour);
        wanted = hn::AndNot(covers, wanted);
        if (lambda == nullptr) continue;
        const LaneMask seen = hn::Or(alone, hn::And(covers, hn::Lt(alpha_of(nearer), number(128))));
        const Vector depth_there = hn::IfThenZeroElse(hn::Eq(farther, zero), surface.lambda_q20);
        hn::StoreU(hn::IfThenElse(seen, depth_there, hn::LoadU(Lanes(), lambda)), Lanes(), lambda);
    }
}

// shape_pixel() of as many lanes as a vector has, from `lane` on.
HWY_INLINE void walk_lanes(const ShapeWalk& walk, const ShapeStrip& strip, int lane, std::int32_t rise_q24,
                           std::int32_t* colour, std::int32_t* lambda) {
    const Vector zero = hn::Zero(Lanes());
    const Vector rise = number(rise_q24);
    const LaneMask alone = hn::MaskFromVec(hn::Load(Lanes(), strip.alone + lane));
    MarchLanes march(walk, strip, lane, rise);
    Vector shown_colour = zero;
    Vector shown_lambda = zero;
    LaneMask looking = hn::MaskFromVec(
        hn::Or(hn::Load(Lanes(), strip.first.used + lane), hn::Load(Lanes(), strip.second.used + lane)));
    LaneMask uncovered = none();  // whose last surface does not cover the pixel
    while (!hn::AllFalse(Lanes(), looking)) {
        Vector depth = march.next(looking);
        const LaneMask at_foot = hn::AndNot(is_surface(depth), alone);
        depth = hn::IfThenElse(at_foot, hn::Load(Lanes(), strip.foot_depth_q3 + lane), depth);
        looking = hn::And(looking, is_surface(depth));
        if (hn::AllFalse(Lanes(), looking)) break;
        const ShownLanes surface = shown_lanes(walk, strip, lane, rise, depth, looking);
        shown_colour = hn::IfThenElse(surface.shown, surface.colour, shown_colour);
        shown_lambda = hn::IfThenElse(surface.shown, surface.lambda_q20, shown_lambda);
        const LaneMask asking = hn::AndNot(hn::Or(surface.shown, alone), looking);
        const LaneMask covers = hn::And(surface.shown, at_least(alpha_of(surface.colour), number(kCoveringAlpha)));
        uncovered = hn::Or(uncovered, hn::And(hn::AndNot(hn::Or(covers, alone), looking), march.ended()));
        looking = hn::AndNot(march.ended(), asking);
    }
    hn::StoreU(shown_colour, Lanes(), colour);
    if (lambda != nullptr) hn::StoreU(hn::IfThenZeroElse(hn::Eq(shown_colour, zero), shown_lambda), Lanes(), lambda);
    if (!hn::AllFalse(Lanes(), uncovered)) {
        alignas(64) std::int32_t rays[kStripColumns];
        hn::Store(hn::VecFromMask(Lanes(), uncovered), Lanes(), rays);
        walk_behind(walk, strip, lane, rise_q24, rays, colour, lambda);
    }
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
    static_assert(sizeof(Rgba8) == sizeof(std::int32_t));
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
