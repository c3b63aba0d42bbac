#pragma once
// Weather in scenes measured in metres: effect on light, air and surfaces. Precipitation is drawn by
// compositor/viewer/drawing/weather_renderer.hpp. Pure; thread-safe.

#include "compositor/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <string>

namespace rs::compositor {

struct Weather {
    bool rain = false;
    bool snow = false;
    bool fog = false;
    std::uint32_t seed = 1;        // of drops and flakes
    glm::dvec3 wind{1.2, 0, 0.4};  // m/s
    double visibility = 140;       // in fog, m: distance at which everything is fogged
    bool operator==(const Weather&) const = default;
};

/// Parses "rain,fog": distinct words from rain, snow and fog, separated by commas. Rain and snow exclude each other.
Result<Weather> parse_weather(const std::string& words);

/// Inverse of parse_weather(); "none" without rain, snow and fog.
std::string weather_words(const Weather& weather);

/// Scene under an overcast sky: less sun, grey light from above; exponential fog as in VRML97 (thin in rain), the
/// background blended towards the fog's colour; Scene::cover. Denser fog of the scene itself is kept.
Scene apply_weather(Scene scene, const Weather& weather);

}  // namespace rs::compositor
