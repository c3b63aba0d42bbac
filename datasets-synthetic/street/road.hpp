#pragma once
// Street surface and furniture: carriageways, pavements, lamps, trees. Everything is appended to a World.

#include "datasets-synthetic/showroom/room_builder.hpp"
#include "datasets-synthetic/street/pen.hpp"

#include <set>
#include <string>
#include <vector>

namespace rs::synthetic {

inline constexpr float kHalfRoad_m = 4;
inline constexpr float kHalfStreet_m = 7;  // from the centre line to the houses
inline constexpr float kKerb_m = 0.14F;
inline constexpr float kLampHeight_m = 5.4F;

void add_road_looks(RoomBuilder& builder, bool night, std::set<std::string>& unlit);

// Both streets and the ground around them, in pieces about 12 m long, because renderers select nearby lights per piece.
void build_roads(World& world);

// The objects "tree_0", "tree_1", "bush" and "lamp", each at the origin.
void build_street_furniture(World& world);

}  // namespace rs::synthetic
