#pragma once
// Light that leaves a source, for those who follow it forwards.

#include "rayspace/light/light.hpp"

#include <glm/glm.hpp>

namespace rs::capture {

struct Photon {
    glm::vec3 origin;
    glm::vec3 direction;     // unit
    glm::vec3 normal{0.0F};  // of the surface that it leaves; 0 where that is a point, or far away
    // Flux over the density with which it was drawn. Of lights without an area it depends on where it arrives: their
    // attenuation may be any.
    glm::vec3 flux{0.0F};
    const Light* point = nullptr;  // such a light
    float inverse_pdf = 0.0F;      // its flux at distance d is irradiance * d^2 * inverse_pdf

    [[nodiscard]] glm::vec3 flux_at(const glm::vec3& position) const {
        if (point == nullptr) return flux;
        const glm::vec3 way = position - origin;
        return irradiance_at(*point, position) * (glm::dot(way, way) * inverse_pdf);
    }
};

}  // namespace rs::capture
