#pragma once
// Evening lighting of a world: a procedural luminaire as an IES file, and a light list that places it at ceilings and
// in lamps (compositor/traced/README.md).

#include "datasets-synthetic/showroom/world.hpp"

#include <string>

namespace rs::synthetic {

inline constexpr const char* kDownlightFile = "downlight.ies";

// LM-63-2002 file: round opening, 560 lumens, intensity proportional to the 1.5th power of the cosine.
std::string downlight_ies();

// Light list that replaces the world's own lights: rows of luminaires about 2 m apart, and one in each point light.
std::string evening_lights(const World& world);

}  // namespace rs::synthetic
