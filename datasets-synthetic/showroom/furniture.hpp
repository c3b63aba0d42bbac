#pragma once
// Furniture of shop and museum, built in the builder's current frame: it faces +Z and stands on y = 0. Requires the
// looks of add_furniture_looks().

#include "datasets-synthetic/shapes/random.hpp"
#include "datasets-synthetic/showroom/room_builder.hpp"

#include <span>
#include <string>
#include <vector>

namespace rs::synthetic {

// Adds the looks of woods, metals, ceramics, cloth. Call once per world.
void add_furniture_looks(RoomBuilder& room);

// A ray-space object or goods on a shelf.
struct ShelfObject {
    int board = 0;          // of ShelfUnit::heights_m
    float x_m = 0.0F;       // of its centre
    std::string name;       // of the recipe
    float height_m = 0.4F;  // of the object
    float turn_deg = 0.0F;
};

// An open shelf unit against a wall: x from 0 to its length, back at z = 0.
struct ShelfUnit {
    std::string name;  // of its textures
    float length_m = 4.8F;
    float depth_m = 0.42F;
    int bays = 4;
    std::vector<float> heights_m{0.62F, 1.22F, 1.82F};  // upper sides of the boards; the cupboard's top first
    float top_m = 2.4F;
    std::vector<ShelfObject> objects;
    std::uint32_t seed = 1;
};
void shelf_unit(RoomBuilder& room, const ShelfUnit& unit);

// Part of a board for goods, centred at `z` from back to front.
struct GoodsArea {
    float x_low = 0.0F;
    float x_high = 1.0F;
    float y = 0.0F;
    float z = 0.0F;
    float depth_m = 0.3F;
    float room_above_m = 0.5F;
};
void books(RoomBuilder& room, const GoodsArea& place, Random& random);
void folded_cloth(RoomBuilder& room, const GoodsArea& place, Random& random);
void pottery(RoomBuilder& room, const GoodsArea& place, Random& random);

// A basket of woven cane with rolls of cloth in it.
void basket(RoomBuilder& room, glm::vec3 foot, float radius_m, float height_m, int rolls, Random& random);

// A pendant lamp at `ceiling`; the shade's lower edge is at `height_m`.
void pendant(RoomBuilder& room, glm::vec3 ceiling, float height_m);

// A card with letters, in front of the surface behind it.
void name_card(RoomBuilder& room, const std::string& texture, const std::string& text, glm::vec3 lower_middle,
               glm::vec2 size_m);

// A pedestal with an object and its name at the front; the top's texture is `name`.png.
void plinth(RoomBuilder& room, const std::string& name, const std::string& object, float width_m, float height_m,
            float object_height_m);

// Brass posts with sagging ropes between them; if `closed`, also from the last to the first.
void rope_barrier(RoomBuilder& room, std::span<const glm::vec3> posts, bool closed);

void bench(RoomBuilder& room, float length_m);

// A framed painting centred at `middle` on a wall at z = 0.
void framed_painting(RoomBuilder& room, const std::string& name, glm::vec3 middle, glm::vec2 size_m,
                     const Painter& painter);

}  // namespace rs::synthetic
