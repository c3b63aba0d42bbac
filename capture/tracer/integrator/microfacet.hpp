#pragma once
// Isotropic GGX microfacet reflection with height-correlated Smith shadowing, Fresnel terms, and albedo tables for
// energy compensation of rough surfaces.
//
// All directions are local: z is the shading normal and points away from the surface. `alpha` = roughness^2, at least
// kMinAlpha. Sources: Walter et al. 2007 (GGX); Heitz 2014 (height-correlated G); Dupuy and Benyoub 2023 (visible
// normals by spherical caps); Turquin 2019 (multiple scattering by albedo scaling).

#include <glm/glm.hpp>

#include <array>

namespace rs::capture {

inline constexpr float kMinAlpha = 1e-3F;

/// Unpolarised reflectance of a smooth dielectric; 1 for total internal reflection.
/// \param ior index behind the surface divided by the index before it
float fresnel_dielectric(float cos_incident, float ior);

/// Schlick's approximation for conductors; `reflectance` at normal incidence.
glm::vec3 fresnel_schlick(float cos_incident, const glm::vec3& reflectance);

/// Samples a microfacet normal visible from wo (wo.z > 0).
glm::vec3 sample_visible_normal(const glm::vec3& wo, float alpha, const glm::vec2& u);

// Microfacet BRDF for reflectance 1. wo.z > 0, wi.z > 0.
struct MicrofacetValue {
    float f_cos;      // BRDF times wi.z
    float pdf;        // of wi with normals from sample_visible_normal()
    float cos_facet;  // between wo and the facets' normal
};
// `lambda_o` is smith_lambda() of wo.
MicrofacetValue evaluate_microfacet(const glm::vec3& wo, const glm::vec3& wi, float alpha, float lambda_o);
// Smith's Lambda for GGX.
float smith_lambda(const glm::vec3& w, float alpha);

// Directional albedo E(cos) of single scattering for one roughness: with reflectance 1 (conductors) or dielectric
// Fresnel reflectance (coats).
class AlbedoTable {
public:
    static AlbedoTable conductor(float alpha);
    static AlbedoTable dielectric(float alpha, float ior);

    // Interpolates linearly in sqrt(cos), because the albedo changes fastest at grazing angles.
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
