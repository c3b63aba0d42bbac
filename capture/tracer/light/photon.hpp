#pragma once
// Photon emitted by a light source, for forward tracing.

#include "capture/tracer/scene/light_scopes.hpp"
#include "rayspace/light/light.hpp"

#include <glm/glm.hpp>

namespace rs::capture {

struct Photon {
    glm::vec3 origin;
    glm::vec3 direction;     // unit
    glm::vec3 normal{0.0F};  // of the emitting surface; 0 for point and distant lights
    // Flux over sampling density. Unused for point lights: their attenuation is arbitrary, so the flux depends on the
    // distance.
    glm::vec3 flux{0.0F};
    const Light* point = nullptr;            // the point light, if it is one
    float inverse_pdf = 0.0F;                // the flux at distance d is irradiance * d^2 * inverse_pdf
    std::uint32_t scoped_light = kUnscoped;  // its first hit is in the scope of this light

    [[nodiscard]] glm::vec3 flux_at(const glm::vec3& position) const {
        if (point == nullptr) return flux;
        const glm::vec3 way = position - origin;
        return irradiance_at(*point, position) * (glm::dot(way, way) * inverse_pdf);
    }
};

}  // namespace rs::capture
