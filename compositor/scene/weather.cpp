#include "compositor/scene/weather.hpp"

#include "rayspace/base/printable.hpp"
#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <utility>

namespace rs::compositor {
namespace {

constexpr double kVisibilityInRain_m = 900;
constexpr double kVisibilityInSnow_m = 320;
constexpr float kCloudTransmittance = 0.35F;
constexpr float kScatteredFraction = 0.3F;  // fraction of the removed sunlight that returns as ambient light

}  // namespace

Result<Weather> parse_weather(const std::string& words) {
    Weather weather;
    std::size_t begin = 0;
    while (begin <= words.size()) {
        const std::size_t end = std::min(words.find(',', begin), words.size());
        const std::string word = words.substr(begin, end - begin);
        bool* const which = word == "rain"   ? &weather.rain
                            : word == "snow" ? &weather.snow
                            : word == "fog"  ? &weather.fog
                                             : nullptr;
        if (which == nullptr) {
            return Error{"--weather: '" + printable(word) + "' is not a weather; give rain, snow or fog, or rain,fog"};
        }
        if (*which) return Error{"--weather: " + word + " is given twice; give it once"};
        *which = true;
        begin = end + 1;
    }
    if (weather.rain && weather.snow) return Error{"--weather: rain and snow at once; give one of them"};
    return weather;
}

std::string weather_words(const Weather& weather) {
    std::string words;
    for (const auto& [is_on, word] :
         {std::pair(weather.rain, "rain"), std::pair(weather.snow, "snow"), std::pair(weather.fog, "fog")}) {
        if (is_on) words += (words.empty() ? "" : ",") + std::string(word);
    }
    return words.empty() ? "none" : words;
}

Scene apply_weather(Scene scene, const Weather& weather) {
    for (Light& light : scene.lights) {
        if (light.kind != LightKind::kDirectional) continue;
        const glm::vec3 lost = light.colour * (1 - kCloudTransmittance);
        light.colour -= lost;
        light.ambient += glm::vec3(luminance(lost) * kScatteredFraction);
    }
    // Distant air has the horizon's colour, desaturated.
    const glm::vec3 horizon = background_colour(scene.background, {1, 0.02, 0});
    const glm::vec3 air = glm::mix(glm::vec3(luminance(horizon)), horizon, 0.25F);
    const float veil = weather.fog ? 1.0F : weather.snow ? 0.95F : 0.75F;
    for (glm::vec3& colour : scene.background.sky) colour = glm::mix(colour, air, veil);
    for (glm::vec3& colour : scene.background.ground) colour = glm::mix(colour, air, veil);
    if (weather.fog) scene.background.images = {};
    // Clouds hide the clear sky of an environment, which still lights the scene.
    if (scene.environment) scene.environment->seen = false;
    const double visibility = weather.fog    ? weather.visibility
                              : weather.snow ? kVisibilityInSnow_m
                                             : kVisibilityInRain_m;
    if (!scene.fog || scene.fog->visibility > visibility) scene.fog = Fog{FogKind::kExponential, air, visibility};
    scene.cover = weather.rain ? Cover::kWet : weather.snow ? Cover::kSnow : Cover::kNone;
    return scene;
}

}  // namespace rs::compositor
