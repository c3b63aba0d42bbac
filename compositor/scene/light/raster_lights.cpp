#include "compositor/scene/light/raster_lights.hpp"

#include "rayspace/light/light_model.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace rs::compositor {
namespace {

constexpr double kReflectance = 0.5;

// Radiant flux. 0 for VRML97 lights, which have an ambient part, and for the sun, which is outside of the room.
glm::dvec3 flux_of(const Light& light) {
    const LightModel& model = model_of(light);
    if (model.words.falls_off && !is_inverse_square(light)) return glm::dvec3(0);
    return model.flux(light, 1);
}

// Mean radiance over all directions.
glm::vec3 mean_of(const EnvironmentLight& light) {
    const Image<RgbaF>& pixels = *light.pixels;
    glm::dvec3 sum(0);
    double weights = 0;
    for (int y = 0; y < pixels.height(); ++y) {
        const double weight = std::sin(kPi * (y + 0.5) / pixels.height());
        for (int x = 0; x < pixels.width(); ++x) {
            const RgbaF& p = pixels(x, y);
            sum += weight * glm::dvec3(p.r, p.g, p.b);
        }
        weights += weight * pixels.width();
    }
    return glm::vec3(sum / weights) * light.scale;
}

Light ambient_light(const char* name, const glm::vec3& radiance) {
    Light light;
    light.name = name;
    light.colour = glm::vec3(0);
    light.ambient = radiance;
    return light;
}

// Caches to_punctual_light() per luminaire, which samples the beam in steps of 0.01 degrees.
class PunctualLights {
public:
    Light of(const Light& light) {
        if (light.luminaire == nullptr) return to_punctual_light(light);
        const auto [known, is_new] = spots_.try_emplace({light.kind, light.luminaire.get()});
        if (is_new) known->second = to_punctual_light(light);
        const LightModel& model = model_of(light);
        Light spot = known->second;
        spot.name = light.name;
        spot.everywhere = light.everywhere;
        spot.location = light.location;
        spot.towards = model.axis(light);
        spot.colour = light.colour * static_cast<float>(model.strength(light) / kPi);
        return spot;
    }

private:
    std::map<std::pair<LightKind, const Luminaire*>, Light> spots_;
};

}  // namespace

glm::vec3 reflected_light(const Scene& scene) {
    glm::dvec3 flux(0);
    for (const Light& light : scene.lights) flux += flux_of(light);
    const BoundingBox box = bounds_of(scene);
    if (box.empty() || !(glm::length(flux) > 0)) return glm::vec3(0);
    const glm::dvec3 size = box.highest - box.lowest;
    const double surface = 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
    // Radiance of a white surface that reflects ambient light in full: irradiance / pi.
    return glm::vec3(flux * kReflectance / ((1 - kReflectance) * std::max(surface, 1e-6) * kPi));
}

std::vector<Light> raster_lights(const Scene& scene, double exposure_ev) {
    std::vector<Light> lights;
    PunctualLights punctual;
    for (const Light& light : scene.lights) lights.push_back(punctual.of(light));
    const glm::vec3 reflected = reflected_light(scene);
    if (reflected != glm::vec3(0)) lights.push_back(ambient_light("reflected", reflected));
    if (scene.environment) lights.push_back(ambient_light("environment", mean_of(*scene.environment)));
    const auto brighter = static_cast<float>(std::exp2(exposure_ev));
    for (Light& light : lights) {
        light.colour *= brighter;
        light.ambient *= brighter;
    }
    return lights;
}

}  // namespace rs::compositor
