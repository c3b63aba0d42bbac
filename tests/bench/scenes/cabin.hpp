#pragma once
// The cabin of an aircraft with 180 seats, lit as such are: by what shines evenly along the ceiling, by the reading
// lights of some passengers, and by the sun through its windows. What instant radiosity was measured on in a flight
// simulator had as many lights.

#include "tests/bench/scenes/model.hpp"

namespace rs::synthetic {

inline constexpr std::int64_t kCabinTriangles =
    2'800'000;  // exactly, where all that stands several times is counted so
inline constexpr int kCabinAreas = 6;
inline constexpr int kCabinSpots = 42;

// The same bits every time. The curtains' fringes take what the rest leaves of the number of triangles.
Model make_cabin();

}  // namespace rs::synthetic
