// What of a virtual light arrives at sixteen surfaces.
#include "capture/tracer/packets/light_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "capture/tracer/packets/virtual_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "capture/tracer/packets/scattering.inl"

HWY_BEFORE_NAMESPACE();
namespace rs::capture::HWY_NAMESPACE {

// f of light that came from the viewer and goes to `out`, without a cosine.
HWY_INLINE Floats3 sent_by(const VirtualLight& light, const Floats3& out, const float* tables) {
    const Floats zero = number(0.0F);
    if (light.kind == SurfaceKind::diffuse) {
        const Floats share =
            hn::IfThenElse(hn::Gt(out.z, zero), number(1.0F - light.translucency), number(light.translucency));
        return broadcast(light.colour) * (share / number(kPiF));
    }
    SeenSurface seen;
    seen.colour = broadcast(light.colour);
    seen.viewer = out;
    seen.table = hn::Set(IntTag(), light.table);
    seen.albedo = albedo_at(tables, seen.table, out.z);
    seen.alpha = number(light.alpha);
    seen.lambda = smith_lambda(out.z, seen.alpha);
    seen.ior = number(light.ior);
    seen.base = number(light.base);
    seen.translucency = number(0.0F);
    const Floats3 from = broadcast(light.viewer);
    const Floats3 f_cos = light.kind == SurfaceKind::glossy ? of_coated(seen, from, tables) : of_metal(seen, from);
    const Floats3 sent = f_cos / greater(from.z, number(1e-4F));
    return either(hn::Gt(out.z, zero), sent, {zero, zero, zero});
}

bool from_virtual(const VirtualLight& light, float bound, const float* tables, const SurfaceLanes& surfaces,
                  const MaskLanes& wanted, LightLanes& arrives) {
    const Floats zero = number(0.0F);
    const Floats3 facet = broadcast(light.geometric_normal);
    const bool thin = light.translucency > 0.0F;
    bool some = false;
    for (std::size_t i = 0; i < kLanes; i += lanes_at_once()) {
        const Floats3 near_start = load(surfaces.near_start, i);
        const Mask open = hn::Gt(load(surfaces.material.translucency, i), zero);
        const Mask before =
            hn::Gt(dot(broadcast(light.position) - near_start, load(surfaces.geometric_normal, i)), zero);
        // From where the ray will start.
        const Floats3 places = either(hn::AndNot(before, open), load(surfaces.far_start, i), near_start);
        Floats3 target = broadcast(light.near_start);
        if (thin) {
            const Floats side = dot(places - broadcast(light.position), facet);
            const Floats step = hn::CopySign(number(light.step_off), side);
            target = broadcast(light.position) + facet * step;
        }
        const Floats3 way = target - places;
        const Floats distance2 = dot(way, way);
        const Floats distance = hn::Sqrt(distance2);
        const Floats3 direction = way / distance;
        const Floats3 back = negated(direction);
        const Floats cos_facet = dot(facet, back);
        const Floats cosine = dot(direction, load(surfaces.normal, i));
        Mask lit = hn::And(load_mask(wanted, i), hn::Gt(distance2, zero));
        if (!thin) lit = hn::And(lit, hn::Gt(cos_facet, zero));
        lit = hn::And(lit, hn::Or(hn::Gt(cosine, zero), open));
        if (!any(lit)) {
            store_mask(lit, arrives.lit, i);
            continue;
        }
        const Floats3 out = {dot(back, broadcast(light.tangent)), dot(back, broadcast(light.bitangent)),
                             dot(back, broadcast(light.normal))};
        Floats geometry = hn::Abs(cos_facet) / distance2;
        const Floats with_cosine = geometry * hn::Abs(cosine);
        const Floats most = number(bound);
        geometry = hn::IfThenElse(hn::Gt(with_cosine, most), geometry * (most / with_cosine), geometry);
        const Floats3 radiance = sent_by(light, out, tables) * broadcast(light.flux) * geometry;
        lit = hn::And(lit, hn::Gt(max_component(radiance), zero));
        store_mask(lit, arrives.lit, i);
        store(direction, arrives.direction, i);
        store(distance, arrives.distance, i);
        store(radiance, arrives.radiance, i);
        some = some || any(lit);
    }
    arrives.delta = true;
    return some;
}

}  // namespace rs::capture::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rs::capture {

HWY_EXPORT(from_virtual);

bool light_from_virtual(const VirtualLight& light, float bound, const float* tables, const SurfaceLanes& surfaces,
                        const MaskLanes& wanted, LightLanes& arrives) {
    return HWY_DYNAMIC_DISPATCH(from_virtual)(light, bound, tables, surfaces, wanted, arrives);
}

}  // namespace rs::capture
#endif  // HWY_ONCE
