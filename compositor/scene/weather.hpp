#pragma once
// Weather of a scene whose unit is the metre: what it does to light, air and surfaces. What falls is drawn by
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
    std::uint32_t seed = 1;        // the same gives the same drops and flakes
    glm::dvec3 wind{1.2, 0, 0.4};  // m/s
    double visibility = 140;       // of fog, m: the distance at which nothing else is seen
    bool operator==(const Weather&) const = default;
};

// "rain,fog": words from rain, snow and fog, each at most once, with commas. Rain and snow exclude each other.
Result<Weather> parse_weather(const std::string& words);

// The scene under an overcast sky: less sun, grey from above; with fog of VRML97's exponential kind (thin where it only
// rains), the background's colours becoming the fog's; with Scene::cover. A scene that has fog of its own keeps it
// where that is thicker.
Scene in_weather(Scene scene, const Weather& weather);

}  // namespace rs::compositor
