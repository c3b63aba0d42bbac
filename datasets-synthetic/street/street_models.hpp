#pragma once
// Models of a street, appended to a World:
//
//     road.cpp         carriageways and pavements
//     furniture.cpp    lamps, traffic lights, benches, bins, bollards, signs
//     trees.cpp        trees with leaf cards
//     houses.cpp       facades (facade.hpp), roofs, and shops whose windows show ray-space objects
//     house_looks.cpp  their walls, windows and doors
//     vehicles.cpp     cars, vans and buses (car_body.hpp), in a world of their own

#include "datasets-synthetic/showroom/room_builder.hpp"
#include "datasets-synthetic/showroom/world.hpp"
#include "datasets-synthetic/street/pen.hpp"

#include <array>
#include <set>
#include <string>
#include <vector>

namespace rs::synthetic {

inline constexpr float kHalfRoad_m = 4;
inline constexpr float kHalfStreet_m = 7;  // from the centre line to the houses
inline constexpr float kKerb_m = 0.14F;
inline constexpr float kLampHeight_m = 5.4F;

void add_road_looks(RoomBuilder& builder);

// Both streets and the ground around them, in pieces about 12 m long, because renderers select nearby lights per piece.
void build_roads(World& world);

// The objects "tree_0" .. "tree_2" and "bush", each at the origin.
inline constexpr int kTrees = 3;
void add_tree_looks(World& world, RoomBuilder& builder, float texture_scale);
void build_trees(World& world);

// Objects of traffic lights, in the order of SignalColour (traffic.hpp).
inline constexpr std::array<const char*, 3> kSignals{"signal_red", "signal_amber", "signal_green"};

// The objects "lamp", "bench", "bin", "bollard", "sign" and those of kSignals, each at the origin, facing +Z.
void add_furniture_looks(RoomBuilder& builder, bool night, std::set<std::string>& unlit);
void build_furniture(World& world);

struct HouseStyle {
    float width_m = 9;
    float depth_m = 10;
    int floors = 3;  // 2 .. 4
    int wall = 0;    // 0 .. kWallLooks - 1
    bool gable = true;
    bool slate = false;      // roof of slates, else of tiles
    bool open_left = false;  // windows on this side, else a blank wall
    bool open_right = false;
    std::string shop;                  // text of its sign, letters A to Z; empty: no shop
    std::vector<std::string> objects;  // recipes of the objects in the shop's window
    bool night = false;
    std::uint32_t seed = 1;
};

inline constexpr int kWallLooks = 8;
inline constexpr int kWindowLooks = 5;
inline constexpr float kWallTile_m = 4;  // size of the wall textures
inline constexpr float kWindowWidth_m = 1.1F;

// Adds the looks of all houses, and the names of emissive ones to `unlit`.
void add_house_looks(World& world, RoomBuilder& builder, float texture_scale, bool night, std::set<std::string>& unlit);

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
