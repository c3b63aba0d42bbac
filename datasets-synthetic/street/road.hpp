#pragma once
// What lies and stands outside of houses: carriageways, pavements, lamps, trees. Everything is appended to a World.

#include "datasets-synthetic/showroom/room_builder.hpp"
#include "datasets-synthetic/street/pen.hpp"

#include <set>
#include <string>
#include <vector>

namespace rs::synthetic {

inline constexpr float kHalfRoad_m = 4;
inline constexpr float kHalfStreet_m = 7;  // to the houses
inline constexpr float kKerb_m = 0.14F;
inline constexpr float kLampHeight_m = 5.4F;

void road_looks(RoomBuilder& builder, bool night, std::set<std::string>& unlit);

// Both streets, in pieces a dozen metres long (lights near by are looked for piece by piece), and the ground around.
void build_roads(World& world);

// The objects "tree_0", "tree_1", "bush" and "lamp", each at the origin.
void build_street_furniture(World& world);

}  // namespace rs::synthetic
