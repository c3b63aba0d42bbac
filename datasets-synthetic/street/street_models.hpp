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
    std::string shop;                  // text of its sign, letters A to Z; empty: no shop
    std::vector<std::string> objects;  // recipes of the objects in the shop's window
    bool night = false;
    std::uint32_t seed = 1;
};

inline constexpr int kWallLooks = 6;

// Adds the looks of all houses, and the names of emissive ones to `unlit`.
void add_house_looks(RoomBuilder& builder, bool night, std::set<std::string>& unlit);

// Builds a house with its front along +X from `origin`, facing +Z before the rotation. Shop objects are added to
// World::objects.
void build_house(World& world, Pen& pen, RoomBuilder& builder, glm::vec3 origin, float turn_deg,
                 const HouseStyle& style);

// World position of a shop's light.
glm::vec3 shop_light(glm::vec3 origin, float turn_deg, const HouseStyle& style);

}  // namespace rs::synthetic
