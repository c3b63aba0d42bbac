#include "compositor/viewer/drawing/raster_lights.hpp"

#include <algorithm>
#include <cmath>

namespace rs::compositor {
namespace {

constexpr double kReflectance = 0.5;

// Radiant; of points and the like 0, for their ambient part is their own.
glm::dvec3 flux_of(const Light& light) {
    const glm::dvec3 colour(light.colour);
    if (light.kind == LightKind::kLuminaire) return colour * (light.luminaire->web.lumens() / kLumensPerWatt);
    return colour * (kPi * area_of(light));
}

}  // namespace

std::vector<Light> raster_lights(const Scene& scene, double exposure_ev) {
    std::vector<Light> lights;
    glm::dvec3 flux(0);
    for (const Light& light : scene.lights) {
        lights.push_back(punctual_of(light));
        flux += flux_of(light);
    }
    const BoundingBox box = bounds_of(scene);
    if (!box.empty() && glm::length(flux) > 0) {
        const glm::dvec3 size = box.highest - box.lowest;
        const double surface = 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
        Light reflected;
        reflected.name = "reflected";
        reflected.colour = glm::vec3(0);
        // Irradiance over pi is what a white surface shows whose material reflects ambient light in full.
        reflected.ambient = glm::vec3(flux * kReflectance / ((1 - kReflectance) * std::max(surface, 1e-6) * kPi));
        lights.push_back(reflected);
    }
    const auto brighter = static_cast<float>(std::exp2(exposure_ev));
    for (Light& light : lights) {
        light.colour *= brighter;
        light.ambient *= brighter;
    }
    return lights;
}

}  // namespace rs::compositor
