#pragma once
// Aircraft cabin with 180 seats, lit by area lights along the ceiling, reading lights of some passengers, and the sun
// through the windows. The number of lights is that of published measurements of instant radiosity in a flight
// simulator.

#include "tests/bench/scenes/model.hpp"

namespace rs::synthetic {

inline constexpr std::int64_t kCabinTriangles = 2'800'000;  // exactly, counting every instance
inline constexpr int kCabinAreas = 6;
inline constexpr int kCabinSpots = 42;

/// Deterministic. The curtains' fringes are sized to reach the exact number of triangles.
Model make_cabin();

}  // namespace rs::synthetic
