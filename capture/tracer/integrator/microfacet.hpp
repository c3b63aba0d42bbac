#pragma once
// The isotropic GGX microfacet reflection with height-correlated Smith shadowing, Fresnel terms, and the albedo tables
// that keep rough surfaces from losing energy.
//
// All directions are local: z is the shading normal, and points away from the surface. `alpha` = roughness^2, at least
// kMinAlpha. Sources: Walter et al. 2007 (GGX); Heitz 2014 (height-correlated G); Dupuy and Benyoub 2023 (visible
// normals by spherical caps); Turquin 2019 (multiple scattering by albedo scaling).

#include <glm/glm.hpp>

#include <array>

namespace rs::capture {

inline constexpr float kMinAlpha = 1e-3F;

// Unpolarised reflectance of a smooth dielectric; `ior` = index behind the surface over the index before it. 1 beyond
// the angle of total reflection.
float fresnel_dielectric(float cos_incident, float ior);

// Schlick's approximation for conductors; `reflectance` at normal incidence.
glm::vec3 fresnel_schlick(float cos_incident, const glm::vec3& reflectance);

// A visible microfacet normal as seen from wo (wo.z > 0).
glm::vec3 sample_visible_normal(const glm::vec3& wo, float alpha, const glm::vec2& u);

// What a microfacet mirror of reflectance 1 sends from wi to wo, times wi.z; and the density of wi when the normal
// comes from sample_visible_normal. wo.z > 0, wi.z > 0.
struct MicrofacetValue {
    float f_cos;
    float pdf;
    float cos_facet;  // between wo and the facets' normal
};
// `lambda_o` is smith_lambda() of wo.
MicrofacetValue evaluate_microfacet(const glm::vec3& wo, const glm::vec3& wi, float alpha, float lambda_o);
// Smith's Lambda for GGX.
float smith_lambda(const glm::vec3& w, float alpha);

// Directional albedo E(cos) of one roughness: the share of the light arriving under `cos` that one scattering reflects.
// Of a perfect mirror's microfacets (conductors), or with dielectric Fresnel reflectance (coats).
class AlbedoTable {
public:
    static AlbedoTable conductor(float alpha);
    static AlbedoTable dielectric(float alpha, float ior);

    // Linear in sqrt(cos), for the albedo changes fastest at grazing angles.
    [[nodiscard]] float at(float cos_angle) const;
    // The cosine-weighted mean, 2 * integral of E(mu) mu d mu.
    [[nodiscard]] float mean() const { return mean_; }

    static constexpr int kSize = 64;
    // E at (i / (kSize - 1))^2.
    [[nodiscard]] const std::array<float, kSize>& values() const { return albedo_; }

private:
    void finish();
    std::array<float, kSize> albedo_{};
    float mean_ = 0.0F;
};

}  // namespace rs::capture
