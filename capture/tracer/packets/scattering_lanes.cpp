// What surfaces make of light.
#include "capture/tracer/packets/light_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "capture/tracer/packets/scattering_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "capture/tracer/packets/scattering.inl"

HWY_BEFORE_NAMESPACE();
namespace rs::capture::HWY_NAMESPACE {

// Sixteen surfaces, of which some lanes are asked about.
class Scattering {
public:
    HWY_INLINE Scattering(const SurfaceLanes& surfaces, const float* tables, std::size_t at)
        : kind_(load(surfaces.material.kind, at)), tables_(tables) {
        seen_ = {load(surfaces.colour, at),
                 load(surfaces.viewer, at),
                 load(surfaces.albedo, at),
                 load(surfaces.lambda, at),
                 load(surfaces.material.alpha, at),
                 load(surfaces.material.ior, at),
                 load(surfaces.material.base, at),
                 load(surfaces.material.translucency, at),
                 hn::Load(IntTag(), surfaces.material.table.of.data() + at)};
    }

    HWY_INLINE Floats3 f_cos(const Floats3& wi, Mask asked) const {
        const Floats zero = number(0.0F);
        const Mask above = hn::Gt(wi.z, zero);
        Floats3 f = {zero, zero, zero};
        const Mask matte = hn::And(asked, of_kind(SurfaceKind::diffuse));
        if (any(matte)) f = either(matte, of_matte(seen_, wi), f);
        const Mask coated = hn::And(hn::And(asked, above), of_kind(SurfaceKind::glossy));
        if (any(coated)) f = either(coated, of_coated(seen_, wi, tables_), f);
        const Mask metal = hn::And(hn::And(asked, above), of_kind(SurfaceKind::metal));
        if (any(metal)) f = either(metal, of_metal(seen_, wi), f);
        return f;
    }
    HWY_INLINE Mask of_kind(SurfaceKind kind) const { return hn::Eq(kind_, number(static_cast<float>(kind))); }

private:
    Floats kind_;
    const float* tables_;
    SeenSurface seen_;
};

bool send(const SurfaceLanes& surfaces, const LightLanes& arrives, const float* tables, SentLanes& sent) {
    const Floats zero = number(0.0F);
    bool some = false;
    for (std::size_t i = 0; i < kLanes; i += lanes_at_once()) {
        const Scattering scattering(surfaces, tables, i);
        const Floats3 direction = load(arrives.direction, i);
        const Floats3 wi = {dot(direction, load(surfaces.tangent, i)), dot(direction, load(surfaces.bitangent, i)),
                            dot(direction, load(surfaces.normal, i))};
        Mask asked = load_mask(arrives.lit, i);
        if (!arrives.delta) asked = hn::AndNot(scattering.of_kind(SurfaceKind::metal), asked);
        const Floats3 f_cos = scattering.f_cos(wi, asked);
        asked = hn::And(asked, hn::Gt(max_component(f_cos), zero));
        store_mask(asked, sent.asked, i);
        if (!any(asked)) continue;
        some = true;

        Floats3 light = f_cos * load(arrives.radiance, i);
        if (!arrives.delta) light = light / load(arrives.pdf, i);
        store(light, sent.light, i);
        // Vertex::start_of()
        const Mask thin = hn::Gt(load(surfaces.material.translucency, i), zero);
        const Floats cosine = hn::IfThenElse(thin, dot(load(surfaces.geometric_normal, i), direction), wi.z);
        store(either(hn::Gt(cosine, zero), load(surfaces.near_start, i), load(surfaces.far_start, i)), sent.ray.origin,
              i);
        store(direction, sent.ray.direction, i);
        store(zero, sent.ray.nearest, i);
        store(load(arrives.distance, i) * number(1.0F - 1e-4F), sent.ray.reach, i);
    }
    return some;
}

void add(const SentLanes& sent, Lanes3& sum) {
    for (std::size_t i = 0; i < kLanes; i += lanes_at_once()) {
        const Mask seen = hn::And(load_mask(sent.asked, i), hn::Ge(load(sent.ray.reach, i), number(0.0F)));
        const Floats3 before = load(sum, i);
        store(either(seen, before + load(sent.light, i), before), sum, i);
    }
}

}  // namespace rs::capture::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rs::capture {

HWY_EXPORT(send);
HWY_EXPORT(add);

bool send_light(const SurfaceLanes& surfaces, const LightLanes& arrives, const float* tables, SentLanes& sent) {
    return HWY_DYNAMIC_DISPATCH(send)(surfaces, arrives, tables, sent);
}

void add_light(const SentLanes& sent, Lanes3& sum) {
    HWY_DYNAMIC_DISPATCH(add)(sent, sum);
}

}  // namespace rs::capture
#endif  // HWY_ONCE
