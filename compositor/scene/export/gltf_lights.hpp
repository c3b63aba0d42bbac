#pragma once
// Lights as KHR_lights_punctual. Pure; thread-safe.

#include "rayspace/light/light.hpp"

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace rs::compositor {

inline constexpr const char* kLightsExtension = "KHR_lights_punctual";

struct GltfLight {
    nlohmann::json light;
    glm::dmat4 world_from_light{1.0};  // the light shines along -Z
    std::vector<std::string> warnings;
};

/// Area lights and luminaires become spots. Attenuations other than the inverse square are matched at a third of the
/// light's reach.
/// \param reach diameter of the scene, > 0; limits the light's radius
GltfLight gltf_light(const Light& light, double reach);

}  // namespace rs::compositor
