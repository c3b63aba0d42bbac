// Light from a virtual light at sixteen surfaces.
#include "capture/tracer/packets/light_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "capture/tracer/packets/virtual_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "capture/tracer/packets/scattering.inl"

HWY_BEFORE_NAMESPACE();
namespace rs::capture::HWY_NAMESPACE {

// BSDF value for light from the viewer direction scattered to `out`, without a cosine.
HWY_INLINE Floats3 reflected_by(const VirtualLight& light, const Floats3& out, const float* tables) {
    const Floats zero = number(0.0F);
    if (light.kind == SurfaceKind::diffuse) {
        const Floats share =
            hn::IfThenElse(hn::Gt(out.z, zero), number(1.0F - light.translucency), number(light.translucency));
        return broadcast(light.colour) * (share / number(kPiF));
    }
    ViewedSurface viewed;
    viewed.colour = broadcast(light.colour);
    viewed.viewer = out;
    viewed.table = hn::Set(IntTag(), light.table);
    viewed.albedo = albedo_at(tables, viewed.table, out.z);
    viewed.alpha = number(light.alpha);
    viewed.lambda = smith_lambda(out.z, viewed.alpha);
    viewed.ior = number(light.ior);
    viewed.base = number(light.base);
    viewed.translucency = number(0.0F);
    const Floats3 from = broadcast(light.viewer);
    const Floats3 f_cos =
        light.kind == SurfaceKind::glossy ? evaluate_glossy(viewed, from, tables) : evaluate_metal(viewed, from);
    const Floats3 reflected = f_cos / greater(from.z, number(1e-4F));
    return either(hn::Gt(out.z, zero), reflected, {zero, zero, zero});
}

bool from_virtual(const VirtualLight& light, float bound, const float* tables, const SurfaceLanes& surfaces,
                  const MaskLanes& active, LightLanes& incident) {
    const Floats zero = number(0.0F);
    const Floats3 facet = broadcast(light.geometric_normal);
    const bool thin = light.translucency > 0.0F;
    bool any_lit = false;
    for (std::size_t i = 0; i < kLanes; i += lanes_at_once()) {
        const Floats3 near_start = load(surfaces.near_start, i);
        const Mask open = hn::Gt(load(surfaces.material.translucency, i), zero);
        const Mask before =
            hn::Gt(dot(broadcast(light.position) - near_start, load(surfaces.geometric_normal, i)), zero);
        // Origins of the shadow rays.
        const Floats3 positions = either(hn::AndNot(before, open), load(surfaces.far_start, i), near_start);
        Floats3 target = broadcast(light.near_start);
        if (thin) {
            const Floats side = dot(positions - broadcast(light.position), facet);
            const Floats step = hn::CopySign(number(light.step_off), side);
            target = broadcast(light.position) + facet * step;
        }
        const Floats3 way = target - positions;
        const Floats distance2 = dot(way, way);
        const Floats distance = hn::Sqrt(distance2);
        const Floats3 direction = way / distance;
        const Floats3 back = negated(direction);
        const Floats cos_facet = dot(facet, back);
        const Floats cosine = dot(direction, load(surfaces.normal, i));
        Mask lit = hn::And(load_mask(active, i), hn::Gt(distance2, zero));
        if (!thin) lit = hn::And(lit, hn::Gt(cos_facet, zero));
        lit = hn::And(lit, hn::Or(hn::Gt(cosine, zero), open));
        if (!any(lit)) {
            store_mask(lit, incident.lit, i);
            continue;
        }
        const Floats3 out = {dot(back, broadcast(light.tangent)), dot(back, broadcast(light.bitangent)),
                             dot(back, broadcast(light.normal))};
        Floats geometry = hn::Abs(cos_facet) / distance2;
        const Floats with_cosine = geometry * hn::Abs(cosine);
        const Floats most = number(bound);
        geometry = hn::IfThenElse(hn::Gt(with_cosine, most), geometry * (most / with_cosine), geometry);
        const Floats3 radiance = reflected_by(light, out, tables) * broadcast(light.flux) * geometry;
        lit = hn::And(lit, hn::Gt(max_component(radiance), zero));
        store_mask(lit, incident.lit, i);
        store(direction, incident.direction, i);
        store(distance, incident.distance, i);
        store(radiance, incident.radiance, i);
        any_lit = any_lit || any(lit);
    }
    incident.delta = true;
    return any_lit;
}

}  // namespace rs::capture::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rs::capture {

HWY_EXPORT(from_virtual);

bool light_from_virtual(const VirtualLight& light, float bound, const float* tables, const SurfaceLanes& surfaces,
                        const MaskLanes& active, LightLanes& incident) {
    return HWY_DYNAMIC_DISPATCH(from_virtual)(light, bound, tables, surfaces, active, incident);
}

}  // namespace rs::capture
#endif  // HWY_ONCE
