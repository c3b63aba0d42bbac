#pragma once
// Houses of the street: walls of brick or plaster, windows, doors, roofs, and shops on the ground floor whose windows
// show ray-space objects. Everything is appended to a World.

#include "datasets-synthetic/showroom/room_builder.hpp"
#include "datasets-synthetic/street/pen.hpp"

#include <set>
#include <string>
#include <vector>

namespace rs::synthetic {

struct HouseStyle {
    float width_m = 9;
    float depth_m = 10;
    int floors = 3;  // 2 .. 4
    int wall = 0;    // 0 .. kWallLooks - 1
    bool gable = true;
    std::string shop;                  // its sign, letters A to Z; empty: a house to live in
    std::vector<std::string> objects;  // recipes, in the shop's window
    bool night = false;
    std::uint32_t seed = 1;
};

inline constexpr int kWallLooks = 6;

// Looks of all houses; those that shine by themselves are added to `unlit`. `builder` paints.
void house_looks(RoomBuilder& builder, bool night, std::set<std::string>& unlit);

// A house whose front stands along +X from the pen's origin and faces +Z. Objects go to World::objects. `sign` names
// the look of the sign, which is painted.
void build_house(World& world, Pen& pen, RoomBuilder& builder, glm::vec3 origin, float turn_deg,
                 const HouseStyle& style);

// Where the light of a shop hangs, in the world.
glm::vec3 shop_light(glm::vec3 origin, float turn_deg, const HouseStyle& style);

}  // namespace rs::synthetic
