#include "capture/tracer/integrator/microfacet.hpp"

#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <cmath>

namespace rs::capture {

namespace {

// Mean over visible normals of Fresnel reflectance times the unshadowed share. A midpoint rule suffices: the integrand
// is smooth.
template <class Fresnel>
float integrate_albedo(float cos_angle, float alpha, Fresnel fresnel) {
    constexpr int kSteps = 24;
    const glm::vec3 wo(std::sqrt(std::max(0.0F, 1.0F - cos_angle * cos_angle)), 0.0F, cos_angle);
    const float lambda_o = smith_lambda(wo, alpha);
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
            // Half a turn suffices by symmetry.
            const glm::vec2 u((static_cast<float>(i) + 0.5F) / (2.0F * kSteps),
                              (static_cast<float>(j) + 0.5F) / kSteps);
            const glm::vec3 normal = sample_visible_normal(wo, alpha, u);
            const float cos_facet = glm::dot(wo, normal);
            const glm::vec3 wi = 2.0F * cos_facet * normal - wo;
            if (wi.z <= 0.0F) continue;
            const float unshadowed = (1.0F + lambda_o) / (1.0F + lambda_o + smith_lambda(wi, alpha));
            sum += static_cast<double>(unshadowed * fresnel(cos_facet));
        }
    }
    return static_cast<float>(sum / (kSteps * kSteps));
}

}  // namespace

float smith_lambda(const glm::vec3& w, float alpha) {
    const float cos2 = w.z * w.z;
    const float tan2 = std::max(0.0F, 1.0F - cos2) / std::max(cos2, 1e-12F);
    return 0.5F * (std::sqrt(1.0F + alpha * alpha * tan2) - 1.0F);
}

float fresnel_dielectric(float cos_incident, float ior) {
    const float c = std::clamp(cos_incident, 0.0F, 1.0F);
    const float sin2_refracted = (1.0F - c * c) / (ior * ior);
    if (sin2_refracted >= 1.0F) return 1.0F;
    const float ct = std::sqrt(1.0F - sin2_refracted);
    const float perpendicular = (c - ior * ct) / (c + ior * ct);
    const float parallel = (ior * c - ct) / (ior * c + ct);
    return 0.5F * (perpendicular * perpendicular + parallel * parallel);
}

glm::vec3 fresnel_schlick(float cos_incident, const glm::vec3& reflectance) {
    const float m = std::clamp(1.0F - cos_incident, 0.0F, 1.0F);
    const float m2 = m * m;
    return reflectance + (glm::vec3(1.0F) - reflectance) * (m2 * m2 * m);
}

glm::vec3 sample_visible_normal(const glm::vec3& wo, float alpha, const glm::vec2& u) {
    const glm::vec3 stretched = glm::normalize(glm::vec3(wo.x * alpha, wo.y * alpha, wo.z));
    const float phi = 2.0F * kPiF * u.x;
    const float z = (1.0F - u.y) * (1.0F + stretched.z) - stretched.z;
    const float sin_theta = std::sqrt(std::clamp(1.0F - z * z, 0.0F, 1.0F));
    const glm::vec3 half = glm::vec3(sin_theta * std::cos(phi), sin_theta * std::sin(phi), z) + stretched;
    return glm::normalize(glm::vec3(half.x * alpha, half.y * alpha, std::max(half.z, 1e-7F)));
}

MicrofacetValue evaluate_microfacet(const glm::vec3& wo, const glm::vec3& wi, float alpha, float lambda_o) {
    const glm::vec3 half = glm::normalize(wo + wi);
    const float alpha2 = alpha * alpha;
    // 1 - z^2 computed as x^2 + y^2: the lobe of a smooth surface is narrower than the rounding error of z^2.
    const float root = alpha2 * half.z * half.z + half.x * half.x + half.y * half.y;
    const float distribution = alpha2 / (kPiF * root * root);
    const float lambda_i = smith_lambda(wi, alpha);
    const float common = distribution / (4.0F * wo.z);
    return {common / (1.0F + lambda_o + lambda_i), common / (1.0F + lambda_o), glm::dot(wo, half)};
}

AlbedoTable AlbedoTable::conductor(float alpha) {
    AlbedoTable table;
    for (int i = 0; i < kSize; ++i) {
        const float x = std::max(static_cast<float>(i) / (kSize - 1), 1e-3F);
        table.albedo_[static_cast<std::size_t>(i)] = integrate_albedo(x * x, alpha, [](float) { return 1.0F; });
    }
    table.finish();
    return table;
}

AlbedoTable AlbedoTable::dielectric(float alpha, float ior) {
    AlbedoTable table;
    for (int i = 0; i < kSize; ++i) {
        const float x = std::max(static_cast<float>(i) / (kSize - 1), 1e-3F);
        table.albedo_[static_cast<std::size_t>(i)] =
            integrate_albedo(x * x, alpha, [ior](float cos_facet) { return fresnel_dielectric(cos_facet, ior); });
    }
    table.finish();
    return table;
}

float AlbedoTable::at(float cos_angle) const {
    const float x = std::sqrt(std::clamp(cos_angle, 0.0F, 1.0F)) * (kSize - 1);
    const auto below = static_cast<std::size_t>(std::min(static_cast<int>(x), kSize - 2));
    return glm::mix(albedo_[below], albedo_[below + 1], x - static_cast<float>(below));
}

void AlbedoTable::finish() {
    constexpr int kSteps = 512;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const float mu = (static_cast<float>(i) + 0.5F) / kSteps;
        sum += static_cast<double>(2.0F * mu * at(mu));
    }
    mean_ = static_cast<float>(sum / kSteps);
}

}  // namespace rs::capture
