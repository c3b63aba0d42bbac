// Vector version of Surface::evaluate() for every SIMD target. No include guard: the sources of this folder include it
// once per target.

#include "capture/tracer/packets/float_lanes.inl"
#include "rayspace/base/conventions.hpp"

HWY_BEFORE_NAMESPACE();
namespace rs::capture::HWY_NAMESPACE {

constexpr float kPiF = static_cast<float>(kPi);

// Vector version of fresnel_dielectric().
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

// Vector version of evaluate_microfacet().
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

// BSDF parameters for a fixed viewer direction, from SurfaceLanes.
struct ViewedSurface {
    Floats3 colour;
    Floats3 viewer;
    Floats albedo, lambda;
    Floats alpha, ior, base, translucency;
    Ints table;
};

HWY_INLINE Floats3 evaluate_diffuse(const ViewedSurface& s, const Floats3& wi) {
    const Mask above = hn::Gt(wi.z, number(0.0F));
    const Floats share = hn::IfThenElse(above, number(1.0F) - s.translucency, s.translucency);
    return s.colour * (share * hn::Abs(wi.z) / number(kPiF));
}

HWY_INLINE Floats3 evaluate_glossy(const ViewedSurface& s, const Floats3& wi, const float* tables) {
    const Floats one = number(1.0F);
    const Facets coat = evaluate_facets(s.viewer, wi, s.alpha, s.lambda);
    const Floats reflected = fresnel_dielectric(coat.cos_facet, s.ior);
    const Floats through = (one - s.albedo) * (one - albedo_at(tables, s.table, wi.z)) / s.base;
    const Floats coated = coat.f_cos * reflected;
    return Floats3{coated, coated, coated} + s.colour * (through * wi.z / number(kPiF));
}

HWY_INLINE Floats3 evaluate_metal(const ViewedSurface& s, const Floats3& wi) {
    const Floats one = number(1.0F);
    const Floats3 ones = {one, one, one};
    const Facets metal = evaluate_facets(s.viewer, wi, s.alpha, s.lambda);
    // fresnel_schlick()
    const Floats m = clamped(one - metal.cos_facet, 0.0F, 1.0F);
    const Floats m2 = m * m;
    const Floats3 reflected = s.colour + (ones - s.colour) * (m2 * m2 * m);
    const Floats3 rescattered = ones + s.colour * ((one - s.albedo) / greater(s.albedo, number(1e-3F)));
    return reflected * rescattered * metal.f_cos;
}

}  // namespace rs::capture::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
