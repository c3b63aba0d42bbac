#pragma once
// Models of a street, appended to a World:
//
//     road.cpp      carriageways, pavements, lamps, trees
//     houses.cpp    walls of brick or plaster, windows, doors, roofs, and shops whose windows show ray-space objects
//     vehicles.cpp  cars, vans and buses, in a world of their own

#include "datasets-synthetic/showroom/room_builder.hpp"
#include "datasets-synthetic/showroom/world.hpp"
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

// Makes cars, vans and buses (traffic.hpp, vehicle_models()) as objects of one model file. They face +X with their
// wheels on y = 0. At night lamps are emissive: their looks are added to `unlit`.
World make_vehicles(bool night, std::set<std::string>& unlit);

}  // namespace rs::synthetic
