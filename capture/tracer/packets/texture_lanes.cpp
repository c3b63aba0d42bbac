// Bilinear texture look-ups with one texture per lane.
#include "capture/tracer/packets/surface_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "capture/tracer/packets/texture_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "capture/tracer/packets/float_lanes.inl"

HWY_BEFORE_NAMESPACE();
namespace rs::capture::HWY_NAMESPACE {

// Vector version of wrap_coordinate() in texture_lookup.cpp.
HWY_INLINE Floats wrap_coordinate(Floats coordinate, Mask repeats, Floats size) {
    const Floats zero = number(0.0F), one = number(1.0F);
    const Floats fraction = coordinate - hn::Floor(coordinate);
    const Mask within = hn::And(hn::Ge(fraction, zero), hn::Lt(fraction, one));
    const Floats half_px = number(0.5F) / size;
    const Floats clamped_coordinate =
        hn::IfThenElse(hn::Gt(coordinate, half_px), lesser(coordinate, one - half_px), half_px);
    return hn::IfThenElse(repeats, hn::IfThenElseZero(within, fraction), clamped_coordinate);
}

struct TexelPair {
    Lanes part;
    MaskLanes before, behind;  // texel indices; `part` is the fraction between them
};

HWY_INLINE void find_texels(Floats place, Floats size, TexelPair& pair, std::size_t at) {
    const IntTag ints;
    const Floats x = place * size - number(0.5F);
    const Floats left = hn::Floor(x);
    store(x - left, pair.part, at);
    const Ints whole = hn::ConvertTo(ints, size), one = hn::Set(ints, 1);
    const Ints found = hn::ConvertTo(ints, left);
    const Ints before = hn::IfThenElse(hn::Lt(found, hn::Zero(ints)), whole - one, found);
    const Ints next = before + one;
    hn::Store(before, ints, pair.before.of.data() + at);
    hn::Store(hn::IfThenElse(hn::Eq(next, whole), hn::Zero(ints), next), ints, pair.behind.of.data() + at);
}

void texture(const std::array<const Texture*, kLanes>& textures, SurfaceLanes& surfaces) {
    Lanes width, height;
    MaskLanes repeat_u, repeat_v;
    for (std::size_t i = 0; i < kLanes; ++i) {
        const Texture* texture = textures[i];
        width[i] = texture == nullptr ? 1.0F : static_cast<float>(texture->pixels.width());
        height[i] = texture == nullptr ? 1.0F : static_cast<float>(texture->pixels.height());
        repeat_u[i] = texture != nullptr && texture->repeat_u ? -1 : 0;
        repeat_v[i] = texture != nullptr && texture->repeat_v ? -1 : 0;
    }
    TexelPair across, down;
    for (std::size_t i = 0; i < kLanes; i += lanes_at_once()) {
        const Floats columns = load(width, i), rows = load(height, i);
        find_texels(wrap_coordinate(load(surfaces.uv.x, i), load_mask(repeat_u, i), columns), columns, across, i);
        find_texels(number(1.0F) - wrap_coordinate(load(surfaces.uv.y, i), load_mask(repeat_v, i), rows), rows, down,
                    i);
    }
    // Four channels at a time, or fewer where vectors are shorter.
    using Channels = hn::CappedTag<float, 4>;
    for (std::size_t i = 0; i < kLanes; ++i) {
        const Texture* texture = textures[i];
        if (texture == nullptr) continue;
        const auto texel = [&](std::int32_t x, std::int32_t y) { return &texture->pixels(x, y).r; };
        const float* upper_left = texel(across.before[i], down.before[i]);
        const float* upper_right = texel(across.behind[i], down.before[i]);
        const float* lower_left = texel(across.before[i], down.behind[i]);
        const float* lower_right = texel(across.behind[i], down.behind[i]);
        alignas(16) float value[4];
        for (std::size_t channel = 0; channel < 4; channel += hn::Lanes(Channels())) {
            const auto mixed = [](auto a, auto b, float part) {
                return a * hn::Set(Channels(), 1.0F - part) + b * hn::Set(Channels(), part);
            };
            const auto of = [&](const float* pixel) { return hn::LoadU(Channels(), pixel + channel); };
            const auto upper = mixed(of(upper_left), of(upper_right), across.part[i]);
            const auto lower = mixed(of(lower_left), of(lower_right), across.part[i]);
            hn::Store(mixed(upper, lower, down.part[i]), Channels(), value + channel);
        }
        surfaces.colour.x[i] *= value[0];
        surfaces.colour.y[i] *= value[1];
        surfaces.colour.z[i] *= value[2];
    }
}

}  // namespace rs::capture::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rs::capture {

HWY_EXPORT(texture);

void texture_surfaces(const std::array<const Texture*, kLanes>& textures, SurfaceLanes& surfaces) {
    HWY_DYNAMIC_DISPATCH(texture)(textures, surfaces);
}

}  // namespace rs::capture
#endif  // HWY_ONCE
