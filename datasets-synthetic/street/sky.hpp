#pragma once
// Daylight for a street: the analytic clear sky of Preetham, Shirley and Smits ("A Practical Analytic Model for
// Daylight", SIGGRAPH 1999) with procedural clouds, and the direction of its sun. Pure; the same bits on every machine.

#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

namespace rs::synthetic {

// Direction in which sunlight travels, of any length.
inline constexpr glm::vec3 kSunAim{0.62F, -0.86F, -0.58F};

// Colour of distant haze by day.
inline constexpr glm::vec3 kHaze{0.6F, 0.69F, 0.78F};

// Radiance of the sky towards the unit vector `direction`, relative to an exposure at which sunlit white paper is about
// 1. The sun's disc is not part of it. Directions below the horizon show the ground's mean colour.
glm::vec3 day_sky(glm::vec3 direction);
glm::vec3 night_sky(glm::vec3 direction);

// Latitude-longitude map of radiance (light lists: "environment"), twice as wide as high.
Image<RgbaF> sky_image(bool night, int height_px);

}  // namespace rs::synthetic
