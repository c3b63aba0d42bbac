// Shading frames and the parts of the BSDF that depend on the viewer only.
#include "capture/tracer/packets/surface_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "capture/tracer/packets/surface_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "capture/tracer/packets/float_lanes.inl"

HWY_BEFORE_NAMESPACE();
namespace rs::capture::HWY_NAMESPACE {

void orient(const Lanes3& directions, const float* tables, SurfaceLanes& surfaces) {
    constexpr float kMinCos = 0.01F;  // facing_normal()
    const Floats one = number(1.0F);
    for (std::size_t i = 0; i < kLanes; i += lanes_at_once()) {
        const Floats3 to_viewer = negated(load(directions, i));
        Floats3 n = load(surfaces.normal, i);
        const Floats cos_viewer = dot(n, to_viewer);
        const Mask away = hn::Not(hn::Ge(cos_viewer, number(kMinCos)));
        if (any(away)) {
            n = either(away, normalised(n + to_viewer * (number(kMinCos) - cos_viewer)), n);
            store(n, surfaces.normal, i);
        }

        // The constructor of Frame.
        const Floats sign = hn::CopySign(one, n.z);
        const Floats a = number(-1.0F) / (sign + n.z);
        const Floats b = n.x * n.y * a;
        const Floats3 tangent = {one + sign * n.x * n.x * a, sign * b, hn::Neg(sign) * n.x};
        const Floats3 bitangent = {b, sign + n.y * n.y * a, hn::Neg(n.y)};
        store(tangent, surfaces.tangent, i);
        store(bitangent, surfaces.bitangent, i);

        const Floats3 viewer = {dot(to_viewer, tangent), dot(to_viewer, bitangent), dot(to_viewer, n)};
        store(viewer, surfaces.viewer, i);
        const Ints table = hn::Load(IntTag(), surfaces.material.table.of.data() + i);
        store(albedo_at(tables, table, viewer.z), surfaces.albedo, i);
        store(smith_lambda(viewer.z, load(surfaces.material.alpha, i)), surfaces.lambda, i);
    }
}

}  // namespace rs::capture::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rs::capture {

HWY_EXPORT(orient);

void orient_surfaces(const Lanes3& direction, const float* tables, SurfaceLanes& surfaces) {
    HWY_DYNAMIC_DISPATCH(orient)(direction, tables, surfaces);
}

}  // namespace rs::capture
#endif  // HWY_ONCE
