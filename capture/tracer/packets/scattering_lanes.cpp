// What surfaces make of light.
#include "capture/tracer/packets/light_lanes.hpp"
#include "rayspace/base/conventions.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "capture/tracer/packets/scattering_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "capture/tracer/packets/float_lanes.inl"

HWY_BEFORE_NAMESPACE();
namespace rs::capture::HWY_NAMESPACE {

constexpr float kPiF = static_cast<float>(kPi);

// The twin of fresnel_dielectric().
HWY_INLINE Floats fresnel_dielectric(Floats cos_incident, Floats ior) {
    const Floats one = number(1.0F);
    const Floats c = clamped(cos_incident, 0.0F, 1.0F);
    const Floats sin2_refracted = (one - c * c) / (ior * ior);
    const Floats ct = hn::Sqrt(one - sin2_refracted);
    const Floats perpendicular = (c - ior * ct) / (c + ior * ct);
    const Floats parallel = (ior * c - ct) / (ior * c + ct);
    return hn::IfThenElse(hn::Ge(sin2_refracted, one), one,
                          number(0.5F) * (perpendicular * perpendicular + parallel * parallel));
}

// The twin of evaluate_microfacet().
struct Facets {
    Floats f_cos, cos_facet;
};
HWY_INLINE Facets evaluate_facets(const Floats3& wo, const Floats3& wi, Floats alpha, Floats lambda_o) {
    const Floats3 half = normalised(wo + wi);
    const Floats alpha2 = alpha * alpha;
    const Floats root = alpha2 * half.z * half.z + half.x * half.x + half.y * half.y;
    const Floats distribution = alpha2 / (number(kPiF) * root * root);
    const Floats lambda_i = smith_lambda(wi.z, alpha);
    const Floats common = distribution / (number(4.0F) * wo.z);
    return {common / (number(1.0F) + lambda_o + lambda_i), dot(wo, half)};
}

// Sixteen surfaces, of which some lanes are asked about.
class Scattering {
public:
    HWY_INLINE Scattering(const SurfaceLanes& surfaces, const float* tables, std::size_t at)
        : surfaces_(surfaces), tables_(tables), at_(at), colour_(load(surfaces.colour, at)) {}

    // The twin of Surface::evaluate().
    HWY_INLINE Floats3 f_cos(const Floats3& wi, Mask asked) const {
        const Floats zero = number(0.0F);
        const Mask above = hn::Gt(wi.z, zero);
        Floats3 f = {zero, zero, zero};
        const Mask matte = hn::And(asked, of_kind(SurfaceKind::diffuse));
        if (any(matte)) f = either(matte, of_matte(wi, above), f);
        const Mask coated = hn::And(hn::And(asked, above), of_kind(SurfaceKind::glossy));
        if (any(coated)) f = either(coated, of_coated(wi), f);
        const Mask metal = hn::And(hn::And(asked, above), of_kind(SurfaceKind::metal));
        if (any(metal)) f = either(metal, of_metal(wi), f);
        return f;
    }
    HWY_INLINE Mask of_kind(SurfaceKind kind) const {
        return hn::Eq(load(surfaces_.material.kind, at_), number(static_cast<float>(kind)));
    }

private:
    HWY_INLINE Floats3 of_matte(const Floats3& wi, Mask above) const {
        const Floats through = load(surfaces_.material.translucency, at_);
        const Floats share = hn::IfThenElse(above, number(1.0F) - through, through);
        return colour_ * (share * hn::Abs(wi.z) / number(kPiF));
    }
    HWY_INLINE Floats3 of_coated(const Floats3& wi) const {
        const Floats one = number(1.0F);
        const Facets coat = facets(wi);
        const Floats reflected = fresnel_dielectric(coat.cos_facet, load(surfaces_.material.ior, at_));
        const Ints table = hn::Load(IntTag(), surfaces_.material.table.of.data() + at_);
        const Floats through = (one - load(surfaces_.albedo, at_)) * (one - albedo_at(tables_, table, wi.z)) /
                               load(surfaces_.material.base, at_);
        const Floats coated = coat.f_cos * reflected;
        return Floats3{coated, coated, coated} + colour_ * (through * wi.z / number(kPiF));
    }
    HWY_INLINE Floats3 of_metal(const Floats3& wi) const {
        const Floats one = number(1.0F);
        const Floats3 ones = {one, one, one};
        const Facets metal = facets(wi);
        // fresnel_schlick()
        const Floats m = clamped(one - metal.cos_facet, 0.0F, 1.0F);
        const Floats m2 = m * m;
        const Floats3 reflected = colour_ + (ones - colour_) * (m2 * m2 * m);
        const Floats albedo = load(surfaces_.albedo, at_);
        const Floats3 rescattered = ones + colour_ * ((one - albedo) / greater(albedo, number(1e-3F)));
        return reflected * rescattered * metal.f_cos;
    }
    HWY_INLINE Facets facets(const Floats3& wi) const {
        return evaluate_facets(load(surfaces_.viewer, at_), wi, load(surfaces_.material.alpha, at_),
                               load(surfaces_.lambda, at_));
    }

    const SurfaceLanes& surfaces_;
    const float* tables_;
    std::size_t at_;
    Floats3 colour_;
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
