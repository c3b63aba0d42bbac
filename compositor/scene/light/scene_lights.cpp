#include "compositor/scene/light/scene_lights.hpp"

#include "rayspace/light/directions.hpp"
#include "rayspace/light/light_model.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace rs::compositor {
namespace {

std::map<std::uint32_t, std::vector<std::uint32_t>> scopes_of(const Scene& scene) {
    if (!scene.listed.scopes.empty()) return scene.listed.scopes;
    std::map<std::uint32_t, std::vector<std::uint32_t>> scopes;
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        if (!scene.lights[i].everywhere) scopes[i];
    }
    for (std::uint32_t n = 0; n < scene.geometry.size(); ++n) {
        for (const std::uint32_t light : scene.geometry[n].lights) scopes[light].push_back(n);
    }
    return scopes;
}

constexpr double kReflectance = 0.5;

// Radiant flux. 0 for VRML97 lights, which have an ambient part, and for the sun, which is outside of the room.
glm::dvec3 flux_of(const Light& light) {
    const LightModel& model = model_of(light);
    if (model.words.falls_off && !is_inverse_square(light)) return glm::dvec3(0);
    return model.flux(light, 1);
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

LightList lights_as_list(const Scene& scene) {
    LightList list;
    list.replace = true;
    list.headlight = scene.navigation.headlight;
    const std::size_t own = scene.lights.size() - scene.listed.entries.size();
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        if (i >= own) {
            list.entries.push_back(scene.listed.entries[i - own]);
        } else {
            if (!check_light(light)) continue;
            list.entries.push_back(entry_from_light(light));
            if (!light.everywhere) list.entries.back().scope = static_cast<std::uint32_t>(i);
        }
        list.lights.push_back(light_of(list.entries.back()));
    }
    list.environment_entry = scene.listed.environment;
    list.environment = environment_of(list.environment_entry);
    return list;
}

Status add_lights(Scene& scene, LightList list, const std::string& from) {
    auto scopes = scopes_of(scene);
    for (std::size_t i = 0; i < list.entries.size(); ++i) {
        const auto& scope = list.entries[i].scope;
        if (!scope || scopes.contains(*scope)) continue;
        return Error{from + ": lights[" + std::to_string(i) + "].scope: the scene's file has no light " +
                     std::to_string(*scope) + " that shines on parts of it only; leave scope out"};
    }
    if (list.replace) {
        scene.lights.clear();
        scene.listed.entries.clear();
        scene.listed.scopes = scopes;
        scene.navigation.headlight = false;
        for (GeometryNode& node : scene.geometry) node.lights.clear();
    }
    scene.navigation.headlight = scene.navigation.headlight || list.headlight;
    for (std::size_t i = 0; i < list.entries.size(); ++i) {
        const auto number = static_cast<std::uint32_t>(scene.lights.size());
        scene.lights.push_back(list.lights[i]);
        if (!list.entries[i].scope) continue;
        for (const std::uint32_t n : scopes[*list.entries[i].scope]) scene.geometry[n].lights.push_back(number);
    }
    scene.listed.entries.insert(scene.listed.entries.end(), list.entries.begin(), list.entries.end());
    scene.listed.environment = std::move(list.environment_entry);
    scene.environment = std::move(list.environment);
    return {};
}

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

std::vector<bool> lights_with_shadows(const Scene& scene) {
    std::vector<bool> casts;
    for (const Light& light : scene.lights) {
        const bool shines = std::max({light.colour.r, light.colour.g, light.colour.b}) > 0;
        casts.push_back(shines && light.casts_shadows && (light.everywhere || light.kind != LightKind::kDirectional));
    }
    for (const GeometryNode& node : scene.geometry) {
        std::optional<std::uint32_t> key;
        for (const std::uint32_t i : node.lights) {
            const Light& light = scene.lights[i];
            if (light.kind != LightKind::kDirectional || !light.casts_shadows || !(luminance(light.colour) > 0))
                continue;
            if (!key || luminance(light.colour) > luminance(scene.lights[*key].colour)) key = i;
        }
        if (key) casts[*key] = true;
    }
    return casts;
}

std::vector<Light> raster_lights(const Scene& scene, double exposure_ev) {
    std::vector<Light> lights;
    PunctualLights punctual;
    for (const Light& light : scene.lights) lights.push_back(punctual.of(light));
    const glm::vec3 reflected = reflected_light(scene);
    if (reflected != glm::vec3(0)) lights.push_back(ambient_light("reflected", reflected));
    const auto brighter = static_cast<float>(std::exp2(exposure_ev));
    for (Light& light : lights) {
        light.colour *= brighter;
        light.ambient *= brighter;
    }
    return lights;
}

}  // namespace rs::compositor
