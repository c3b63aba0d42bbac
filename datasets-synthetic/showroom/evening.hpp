#pragma once
// The lights of a world's evening: a luminaire of our own as an IES file, and a list that hangs it under the ceilings
// and in the lamps (compositor/traced/README.md).

#include "datasets-synthetic/showroom/world.hpp"

#include <string>

namespace rs::synthetic {

inline constexpr const char* kDownlightFile = "downlight.ies";

// LM-63-2002: round, 560 lumens, its intensity as the 1.5th power of the cosine.
std::string downlight_ies();

// In place of the world's own lights: luminaires in rows, some 2 m apart, and one in each lamp that is a point light.
std::string evening_lights(const World& world);

}  // namespace rs::synthetic
