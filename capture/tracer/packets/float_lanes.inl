// Vector arithmetic for every SIMD target, in the operation order of the scalar code. No include guard: the sources of
// this folder include it once per target.

#include "capture/tracer/packets/packet.hpp"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rs::capture::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, kLanes>;
using IntTag = hn::RebindToSigned<FloatTag>;
using Floats = hn::Vec<FloatTag>;
using Ints = hn::Vec<IntTag>;
using Mask = hn::Mask<FloatTag>;

HWY_INLINE std::size_t lanes_at_once() {
    return hn::Lanes(FloatTag());
}

HWY_INLINE Floats number(float value) {
    return hn::Set(FloatTag(), value);
}
HWY_INLINE Floats load(const Lanes& lanes, std::size_t at) {
    return hn::Load(FloatTag(), lanes.of.data() + at);
}
HWY_INLINE void store(Floats v, Lanes& lanes, std::size_t at) {
    hn::Store(v, FloatTag(), lanes.of.data() + at);
}
HWY_INLINE Mask load_mask(const MaskLanes& lanes, std::size_t at) {
    const IntTag ints;
    return hn::RebindMask(FloatTag(), hn::Lt(hn::Load(ints, lanes.of.data() + at), hn::Zero(ints)));
}
HWY_INLINE void store_mask(Mask mask, MaskLanes& lanes, std::size_t at) {
    const IntTag ints;
    hn::Store(hn::BitCast(ints, hn::VecFromMask(FloatTag(), mask)), ints, lanes.of.data() + at);
}
HWY_INLINE bool any(Mask mask) {
    return !hn::AllFalse(FloatTag(), mask);
}

// NaN semantics of std::max and std::min, which return their first argument if one is NaN.
HWY_INLINE Floats greater(Floats a, Floats b) {
    return hn::IfThenElse(hn::Lt(a, b), b, a);
}
HWY_INLINE Floats lesser(Floats a, Floats b) {
    return hn::IfThenElse(hn::Lt(b, a), b, a);
}
HWY_INLINE Floats clamped(Floats v, float low, float high) {
    return lesser(greater(v, number(low)), number(high));
}

struct Floats3 {
    Floats x, y, z;
};
HWY_INLINE Floats3 load(const Lanes3& lanes, std::size_t at) {
    return {load(lanes.x, at), load(lanes.y, at), load(lanes.z, at)};
}
HWY_INLINE void store(const Floats3& v, Lanes3& lanes, std::size_t at) {
    store(v.x, lanes.x, at);
    store(v.y, lanes.y, at);
    store(v.z, lanes.z, at);
}
HWY_INLINE Floats3 broadcast(const glm::vec3& v) {
    return {number(v.x), number(v.y), number(v.z)};
}
HWY_INLINE Floats3 operator+(const Floats3& a, const Floats3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE Floats3 operator-(const Floats3& a, const Floats3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE Floats3 operator*(const Floats3& a, Floats b) {
    return {a.x * b, a.y * b, a.z * b};
}
HWY_INLINE Floats3 operator*(const Floats3& a, const Floats3& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
HWY_INLINE Floats3 operator/(const Floats3& a, Floats b) {
    return {a.x / b, a.y / b, a.z / b};
}
HWY_INLINE Floats3 negated(const Floats3& v) {
    return {hn::Neg(v.x), hn::Neg(v.y), hn::Neg(v.z)};
}
HWY_INLINE Floats3 either(Mask mask, const Floats3& yes, const Floats3& no) {
    return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z)};
}
HWY_INLINE Floats dot(const Floats3& a, const Floats3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
HWY_INLINE Floats3 cross(const Floats3& a, const Floats3& b) {
    return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
HWY_INLINE Floats length(const Floats3& v) {
    return hn::Sqrt(dot(v, v));
}
HWY_INLINE Floats3 normalised(const Floats3& v) {
    return v * (number(1.0F) / hn::Sqrt(dot(v, v)));
}
HWY_INLINE Floats max_component(const Floats3& v) {
    return greater(v.x, greater(v.y, v.z));
}

// Vector version of smith_lambda().
HWY_INLINE Floats smith_lambda(Floats cosine, Floats alpha) {
    const Floats one = number(1.0F);
    const Floats cos2 = cosine * cosine;
    const Floats tan2 = greater(number(0.0F), one - cos2) / greater(cos2, number(1e-12F));
    return number(0.5F) * (hn::Sqrt(one + alpha * alpha * tan2) - one);
}

// Vector version of AlbedoTable::at().
HWY_INLINE Floats albedo_at(const float* tables, Ints table, Floats cosine) {
    const IntTag ints;
    const Floats x = hn::Sqrt(clamped(cosine, 0.0F, 1.0F)) * number(kAlbedoNumbers - 1);
    // Inactive lanes may contain NaN.
    const Ints below = hn::Max(hn::Min(hn::ConvertTo(ints, x), hn::Set(ints, kAlbedoNumbers - 2)), hn::Zero(ints));
    const Ints index = table + below;
    const Floats part = x - hn::ConvertTo(FloatTag(), below);
    return hn::GatherIndex(FloatTag(), tables, index) * (number(1.0F) - part) +
           hn::GatherIndex(FloatTag(), tables + 1, index) * part;
}

}  // namespace rs::capture::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
