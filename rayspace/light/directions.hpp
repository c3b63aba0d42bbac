#pragma once
// Directions on the sphere: frames, sampling, luminance, MIS weights.

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace rs {

inline constexpr float kPiF = 3.14159265358979323846F;

// Rec. 709 luminance of linear-light RGB.
inline float luminance(const glm::vec3& colour) {
    return glm::dot(colour, glm::vec3(0.2126F, 0.7152F, 0.0722F));
}

inline float max_component(const glm::vec3& v) {
    return std::max(v.x, std::max(v.y, v.z));
}

// Orthonormal axes about a unit normal, which is the local z axis (Duff et al., "Building an Orthonormal Basis,
// Revisited", JCGT 6(1), 2017).
struct Frame {
    glm::vec3 tangent;
    glm::vec3 bitangent;
    glm::vec3 normal;

    explicit Frame(const glm::vec3& n) : normal(n) {
        const float sign = std::copysign(1.0F, n.z);
        const float a = -1.0F / (sign + n.z);
        const float b = n.x * n.y * a;
        tangent = {1.0F + sign * n.x * n.x * a, sign * b, -sign * n.x};
        bitangent = {b, sign + n.y * n.y * a, -n.y};
    }
    [[nodiscard]] glm::vec3 to_local(const glm::vec3& v) const {
        return {glm::dot(v, tangent), glm::dot(v, bitangent), glm::dot(v, normal)};
    }
    [[nodiscard]] glm::vec3 to_world(const glm::vec3& v) const {
        return tangent * v.x + bitangent * v.y + normal * v.z;
    }
};

// Uniform sample of the unit disc.
inline glm::vec2 sample_disc(const glm::vec2& u) {
    return std::sqrt(u.x) * glm::vec2(std::cos(2.0F * kPiF * u.y), std::sin(2.0F * kPiF * u.y));
}

// Uniform direction in the cone about +z with cosine >= `min_cos`.
inline glm::vec3 sample_cone(const glm::vec2& u, float min_cos) {
    const float z = 1.0F - u.x * (1.0F - min_cos);
    const float r = std::sqrt(std::max(0.0F, 1.0F - z * z));
    return {r * std::cos(2.0F * kPiF * u.y), r * std::sin(2.0F * kPiF * u.y), z};
}

// Direction in the hemisphere about +z with density cos / pi.
inline glm::vec3 sample_cosine_hemisphere(const glm::vec2& u) {
    const float radius = std::sqrt(u.x);
    const float phi = 2.0F * kPiF * u.y;
    return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(std::max(0.0F, 1.0F - u.x))};
}

// Veach's power heuristic (exponent 2) for one sample of each of two strategies.
inline float mis_weight(float pdf, float other_pdf) {
    const float ratio = other_pdf / pdf;
    return 1.0F / (1.0F + ratio * ratio);
}

}  // namespace rs
