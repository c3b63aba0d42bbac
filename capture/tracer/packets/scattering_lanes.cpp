// Light reflected by sixteen surfaces.
#include "capture/tracer/packets/light_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "capture/tracer/packets/scattering_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "capture/tracer/packets/scattering.inl"

HWY_BEFORE_NAMESPACE();
namespace rs::capture::HWY_NAMESPACE {

// BSDF of sixteen surfaces.
class Scattering {
public:
    HWY_INLINE Scattering(const SurfaceLanes& surfaces, const float* tables, std::size_t at)
        : kind_(load(surfaces.material.kind, at)), tables_(tables) {
        surface_ = {load(surfaces.colour, at),
                    load(surfaces.viewer, at),
                    load(surfaces.albedo, at),
                    load(surfaces.lambda, at),
                    load(surfaces.material.alpha, at),
                    load(surfaces.material.ior, at),
                    load(surfaces.material.base, at),
                    load(surfaces.material.translucency, at),
                    hn::Load(IntTag(), surfaces.material.table.of.data() + at)};
    }

    HWY_INLINE Floats3 f_cos(const Floats3& wi, Mask active) const {
        const Floats zero = number(0.0F);
        const Mask above = hn::Gt(wi.z, zero);
        Floats3 f = {zero, zero, zero};
        const Mask matte = hn::And(active, has_kind(SurfaceKind::diffuse));
        if (any(matte)) f = either(matte, evaluate_diffuse(surface_, wi), f);
        const Mask coated = hn::And(hn::And(active, above), has_kind(SurfaceKind::glossy));
        if (any(coated)) f = either(coated, evaluate_glossy(surface_, wi, tables_), f);
        const Mask metal = hn::And(hn::And(active, above), has_kind(SurfaceKind::metal));
        if (any(metal)) f = either(metal, evaluate_metal(surface_, wi), f);
        return f;
    }
    HWY_INLINE Mask has_kind(SurfaceKind kind) const { return hn::Eq(kind_, number(static_cast<float>(kind))); }

private:
    Floats kind_;
    const float* tables_;
    ViewedSurface surface_;
};

bool reflect(const SurfaceLanes& surfaces, const LightLanes& incident, const float* tables, ShadowLanes& shadows) {
    const Floats zero = number(0.0F);
    bool any_ray = false;
    for (std::size_t i = 0; i < kLanes; i += lanes_at_once()) {
        const Scattering scattering(surfaces, tables, i);
        const Floats3 direction = load(incident.direction, i);
        const Floats3 wi = {dot(direction, load(surfaces.tangent, i)), dot(direction, load(surfaces.bitangent, i)),
                            dot(direction, load(surfaces.normal, i))};
        Mask active = load_mask(incident.lit, i);
        if (!incident.delta) active = hn::AndNot(scattering.has_kind(SurfaceKind::metal), active);
        const Floats3 f_cos = scattering.f_cos(wi, active);
        active = hn::And(active, hn::Gt(max_component(f_cos), zero));
        store_mask(active, shadows.active, i);
        if (!any(active)) continue;
        any_ray = true;

        Floats3 light = f_cos * load(incident.radiance, i);
        if (!incident.delta) light = light / load(incident.pdf, i);
        store(light, shadows.light, i);
        // Vertex::start_of()
        const Mask thin = hn::Gt(load(surfaces.material.translucency, i), zero);
        const Floats cosine = hn::IfThenElse(thin, dot(load(surfaces.geometric_normal, i), direction), wi.z);
        store(either(hn::Gt(cosine, zero), load(surfaces.near_start, i), load(surfaces.far_start, i)),
              shadows.ray.origin, i);
        store(direction, shadows.ray.direction, i);
        store(zero, shadows.ray.nearest, i);
        store(load(incident.distance, i) * number(1.0F - 1e-4F), shadows.ray.reach, i);
    }
    return any_ray;
}

void add(const ShadowLanes& shadows, Lanes3& sum) {
    for (std::size_t i = 0; i < kLanes; i += lanes_at_once()) {
        const Mask unoccluded = hn::And(load_mask(shadows.active, i), hn::Ge(load(shadows.ray.reach, i), number(0.0F)));
        const Floats3 before = load(sum, i);
        store(either(unoccluded, before + load(shadows.light, i), before), sum, i);
    }
}

}  // namespace rs::capture::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rs::capture {

HWY_EXPORT(reflect);
HWY_EXPORT(add);

bool reflect_light(const SurfaceLanes& surfaces, const LightLanes& incident, const float* tables,
                   ShadowLanes& shadows) {
    return HWY_DYNAMIC_DISPATCH(reflect)(surfaces, incident, tables, shadows);
}

void add_light(const ShadowLanes& shadows, Lanes3& sum) {
    HWY_DYNAMIC_DISPATCH(add)(shadows, sum);
}

}  // namespace rs::capture
#endif  // HWY_ONCE
