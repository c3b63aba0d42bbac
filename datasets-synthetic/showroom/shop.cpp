#include "datasets-synthetic/showroom/showroom.hpp"

#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/showroom/furniture.hpp"
#include "datasets-synthetic/showroom/painting.hpp"
#include "datasets-synthetic/showroom/room_shell.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

constexpr vec3 kShopLow{-4.0F, 0.0F, 0.0F};
constexpr vec3 kShopHigh{4.0F, 3.2F, 7.0F};
constexpr vec2 kRugLow{-2.6F, 2.75F};  // x, z
constexpr vec2 kRugHigh{0.0F, 4.85F};
constexpr vec2 kTableLow{-2.0F, 3.35F};
constexpr vec2 kTableHigh{-0.6F, 4.25F};
constexpr float kTable_m = 0.8F;
constexpr vec2 kCounterLow{1.75F, 2.0F};
constexpr vec2 kCounterHigh{2.4F, 4.5F};
constexpr float kCounter_m = 0.95F;

void shop_floor_and_ceiling(RoomBuilder& room) {
    const std::vector<Footprint> prints{
        {{-4.0F, 0.95F}, {-3.58F, 6.05F}, 0.3F, 0.6F},
        {{3.58F, 0.75F}, {4.0F, 4.45F}, 0.3F, 0.6F},
        {kCounterLow, kCounterHigh, 0.28F, 0.6F},
        {{-2.85F, 0.2F}, {-2.35F, 0.7F}, 0.12F, 0.6F, true},
        {{-2.2F, 0.12F}, {-1.8F, 0.52F}, 0.12F, 0.6F, true},
        {{1.5F, 0.2F}, {2.0F, 0.7F}, 0.15F, 0.5F},
        {kRugLow, kRugHigh, 0.02F, 0.35F},
    };
    const vec2 size{kShopHigh.x - kShopLow.x, kShopHigh.z - kShopLow.z};
    const WoodTone oak{srgb(0xC79C6A), srgb(0x8A5E36)};
    room.painted_sheet("shop_floor", {{kShopLow.x, 0, kShopHigh.z}, {size.x, 0, 0}, {0, 0, -size.y}}, 120,
                       [&](vec2 p) {
                           const vec2 place{kShopLow.x + p.x, kShopHigh.z - p.y};
                           const float wall = corner_shadow(std::min(p.x, size.x - p.x), 0.4F, 0.3F);
                           return planks(p, 0.16F, 1.9F, oak, 31) * wall * contact_shadow(place, prints);
                       },
                       {.specular = 0x2A2622, .shininess = 0.3F});
    room.painted_sheet("shop_ceiling", {{kShopLow.x, kShopHigh.y, kShopLow.z}, {size.x, 0, 0}, {0, 0, size.y}}, 40,
                       plaster_painter(size, srgb(0xF3E9D6), 32));
    for (int k = 0; k < 5; ++k) {
        const float z = 0.9F + 1.3F * static_cast<float>(k);
        room.box("oak", {kShopLow.x, kShopHigh.y - 0.17F, z - 0.07F}, {kShopHigh.x, kShopHigh.y, z + 0.07F});
    }
}

// Boarding in sage below a rail, plaster above it.
constexpr float kRail_m = 0.95F;
Painter shop_wall(vec2 size_m, vec3 colour, std::uint32_t seed) {
    const Painter above = plaster_painter(size_m, colour, seed);
    const Painter below = plaster_painter(size_m, srgb(0x93A184), seed);
    return [=](vec2 p) {
        if (p.y > kRail_m) return above(p) * (0.9F + 0.14F * smooth_step(kRail_m, 2.2F, p.y));
        const float in_board = p.x / 0.12F - std::floor(p.x / 0.12F);
        const float groove = 0.72F + 0.28F * smooth_step(0.0F, 0.07F, std::min(in_board, 1.0F - in_board));
        return below(p) * groove;
    };
}

void shop_walls(RoomBuilder& room) {
    const float width = kShopHigh.x - kShopLow.x;
    const float depth = kShopHigh.z - kShopLow.z;
    const float height = kShopHigh.y;
    const vec3 cream = srgb(0xEBD9B7);
    room.painted_sheet("shop_wall_left", {{kShopLow.x, 0, kShopHigh.z}, {0, 0, -depth}, {0, height, 0}}, 100,
                       shop_wall({depth, height}, cream, 33));
    room.painted_sheet("shop_wall_right", {{kShopHigh.x, 0, kShopLow.z}, {0, 0, depth}, {0, height, 0}}, 100,
                       shop_wall({depth, height}, cream, 34));
    wall(room, "shop_wall_door", {{kShopLow.x, 0, 0}, {width, 0, 0}, {0, height, 0}}, 100,
         shop_wall({width, height}, srgb(0xD9BC92), 35),
         Opening{{-kShopLow.x - kDoorHalf_m, 0}, {-kShopLow.x + kDoorHalf_m, kDoorHeight_m}});
    wall(room, "shop_wall_window", {{kShopHigh.x, 0, kShopHigh.z}, {-width, 0, 0}, {0, height, 0}}, 100,
         shop_wall({width, height}, cream, 36), Opening{{0.5F, 0.5F}, {width - 0.5F, 2.6F}});
    const MouldingGap door{-kDoorHalf_m - 0.12F, kDoorHalf_m + 0.12F};
    moulding(room, "walnut", kShopLow, {kShopHigh.x, 0.12F, kShopHigh.z}, 0.02F, door);
    room.box("walnut", {kShopLow.x, kRail_m - 0.03F, 0}, {door.low_x, kRail_m + 0.02F, 0.025F});
    room.box("walnut", {door.high_x, kRail_m - 0.03F, 0}, {kShopHigh.x, kRail_m + 0.02F, 0.025F});
}

void shop_window(RoomBuilder& room) {
    const float z = kShopHigh.z;
    for (const float x : {-3.5F, -2.0F, -0.55F, 0.55F, 2.0F, 3.5F}) {
        room.box("green_paint", {x - 0.04F, 0.5F, z - 0.05F}, {x + 0.04F, 2.6F, z + 0.05F});
    }
    room.box("green_paint", {-3.6F, 0.42F, z - 0.14F}, {3.6F, 0.5F, z + 0.06F});
    room.box("green_paint", {-3.5F, 2.05F, z - 0.04F}, {3.5F, 2.12F, z + 0.04F});
    room.box("green_paint", {-3.6F, 2.6F, z - 0.06F}, {3.6F, 2.7F, z + 0.06F});
}

void doorway(RoomBuilder& room) {
    const float x = kDoorHalf_m;
    const float top = kDoorHeight_m;
    const float back = -kWallBetween_m;
    room.box("walnut", {-x - 0.12F, 0, 0}, {-x, top + 0.12F, 0.035F});
    room.box("walnut", {x, 0, 0}, {x + 0.12F, top + 0.12F, 0.035F});
    room.box("walnut", {-x, top, 0}, {x, top + 0.12F, 0.035F});
    room.sheet("walnut", {{-x, 0, 0}, {0, 0, back}, {0, top, 0}}, {0, 0}, {-back, top});
    room.sheet("walnut", {{x, 0, back}, {0, 0, -back}, {0, top, 0}}, {0, 0}, {-back, top});
    room.sheet("walnut", {{-x, top, back}, {2 * x, 0, 0}, {0, 0, -back}}, {0, 0}, {2 * x, -back});
    room.painted_sheet("threshold", {{-x, 0, 0}, {2 * x, 0, 0}, {0, 0, back}}, 120, [&](vec2 p) {
        return plaster(p * 3.0F, srgb(0x8C8880), 37) * corner_shadow(std::min(p.x, 2 * x - p.x), 0.12F, 0.4F);
    });
    const vec2 sign{1.3F, 0.26F};
    const auto ink = lettering("MUSEUM", sign, 0.13F, 0.02F);
    room.soft_box("green_paint", {-0.72F, 2.64F, 0}, {0.72F, 2.98F, 0.04F}, 0.012F);
    room.painted_sheet("museum_sign", {{-0.65F, 2.68F, 0.042F}, {sign.x, 0, 0}, {0, sign.y, 0}}, 220, [&](vec2 p) {
        const float share = ink(p);
        return srgb(0x33503F) * (1.0F - share) + srgb(0xE8CF9A) * share;
    });
}

void shelves(RoomBuilder& room) {
    ShelfUnit left;
    left.name = "shelf_left";
    left.length_m = 5.0F;
    left.seed = 41;
    left.objects = {{1, 0.62F, "vase", 0.46F, 0},
                    {1, 1.86F, "lamp", 0.49F, 40},
                    {1, 3.12F, "doll", 0.38F, 0},
                    {1, 4.36F, "flower", 0.46F, 120}};
    room.set_frame({kShopLow.x, 0, 6.0F}, 90);
    shelf_unit(room, left);
    Random random(411);
    const float z = 0.2F;
    pottery(room, {0.08F, 0.40F, 1.22F, z, 0.3F, 0.55F}, random);
    pottery(room, {0.86F, 1.2F, 1.22F, z, 0.3F, 0.55F}, random);
    books(room, {2.15F, 2.47F, 1.22F, z, 0.3F, 0.55F}, random);
    pottery(room, {3.4F, 3.72F, 1.22F, z, 0.3F, 0.55F}, random);
    folded_cloth(room, {0.3F, 1.0F, 0.62F, z, 0.32F, 0.5F}, random);
    pottery(room, {1.5F, 2.3F, 0.62F, z, 0.3F, 0.5F}, random);
    books(room, {2.54F, 3.2F, 0.62F, z, 0.3F, 0.55F}, random);
    folded_cloth(room, {3.95F, 4.7F, 0.62F, z, 0.32F, 0.5F}, random);
    books(room, {0.1F, 0.8F, 1.82F, z, 0.3F, 0.55F}, random);
    pottery(room, {1.5F, 2.2F, 1.82F, z, 0.3F, 0.5F}, random);
    folded_cloth(room, {2.75F, 3.45F, 1.82F, z, 0.32F, 0.4F}, random);
    pottery(room, {3.95F, 4.65F, 1.82F, z, 0.3F, 0.5F}, random);

    ShelfUnit right;
    right.name = "shelf_right";
    right.length_m = 3.6F;
    right.bays = 3;
    right.seed = 42;
    right.objects = {{1, 0.6F, "lattice", 0.36F, 20}, {1, 1.8F, "blocks", 0.38F, 30}, {1, 3.0F, "vase", 0.44F, 90}};
    room.set_frame({kShopHigh.x, 0, 0.8F}, -90);
    shelf_unit(room, right);
    books(room, {0.08F, 0.33F, 1.22F, z, 0.3F, 0.55F}, random);
    pottery(room, {2.1F, 2.42F, 1.22F, z, 0.3F, 0.55F}, random);
    pottery(room, {0.25F, 1.0F, 0.62F, z, 0.3F, 0.5F}, random);
    folded_cloth(room, {1.45F, 2.15F, 0.62F, z, 0.32F, 0.5F}, random);
    pottery(room, {2.65F, 3.35F, 0.62F, z, 0.3F, 0.5F}, random);
    pottery(room, {0.25F, 0.95F, 1.82F, z, 0.3F, 0.5F}, random);
    books(room, {1.3F, 2.1F, 1.82F, z, 0.3F, 0.55F}, random);
    folded_cloth(room, {2.65F, 3.35F, 1.82F, z, 0.32F, 0.4F}, random);
    room.set_frame({0, 0, 0});
}

void table(RoomBuilder& room) {
    const vec2 rug_size = kRugHigh - kRugLow;
    const Footprint under{kTableLow, kTableHigh, 0.45F, 0.42F};
    room.box_with_top(
        "cloth0", "shop_rug", {kRugLow.x, 0, kRugLow.y}, {kRugHigh.x, 0.012F, kRugHigh.y}, 160, [&](vec2 p) {
            return rug(p, rug_size, 51) * contact_shadow({kRugLow.x + p.x, kRugHigh.y - p.y}, std::span(&under, 1));
        });
    const vec2 size = kTableHigh - kTableLow;
    struct Stand {
        const char* name;
        vec2 place;
        float height_m;
        float turn_deg;
    };
    const Stand stands[] = {{"blocks", {0.38F, 0.45F}, 0.34F, 20}, {"flower", {1.02F, 0.43F}, 0.52F, 0}};
    std::vector<Footprint> prints;
    for (const Stand& stand : stands) {
        const float half = foot_radius(stand.name, stand.height_m);
        prints.push_back({stand.place - half, stand.place + half, 0.06F, 0.5F, true});
    }
    const WoodTone tone{srgb(0x9A6A44), srgb(0x5A3822)};
    room.box_with_top("walnut", "shop_table", {kTableLow.x, kTable_m - 0.04F, kTableLow.y},
                      {kTableHigh.x, kTable_m, kTableHigh.y}, 260,
                      [&](vec2 p) { return wood(p, tone, 52) * contact_shadow(p, prints); });
    const float inset = 0.06F;
    room.box("walnut", {kTableLow.x + inset, kTable_m - 0.13F, kTableLow.y + inset},
             {kTableHigh.x - inset, kTable_m - 0.04F, kTableHigh.y - inset});
    for (const float x : {kTableLow.x + inset, kTableHigh.x - inset - 0.07F}) {
        for (const float z : {kTableLow.y + inset, kTableHigh.y - inset - 0.07F}) {
            room.box("walnut", {x, 0.012F, z}, {x + 0.07F, kTable_m - 0.13F, z + 0.07F});
        }
    }
    for (const Stand& stand : stands) {
        room.object(stand.name, {kTableLow.x + stand.place.x, kTable_m, kTableHigh.y - stand.place.y}, stand.turn_deg,
                    stand.height_m);
    }
    pendant(room, {0.5F * (kTableLow.x + kTableHigh.x), kShopHigh.y, 0.5F * (kTableLow.y + kTableHigh.y)}, 2.1F);
    Random random(531);
    pottery(room,
            {kTableLow.x + size.x * 0.5F - 0.16F, kTableLow.x + size.x * 0.5F + 0.12F, kTable_m, kTableHigh.y - 0.2F,
             0.2F, 0.2F},
            random);
}

// In the counter's frame: its front faces +Z, x from 0 to its length.
void counter(RoomBuilder& room) {
    const float length = kCounterHigh.y - kCounterLow.y;
    const float depth = kCounterHigh.x - kCounterLow.x;
    room.set_frame({kCounterHigh.x, 0, kCounterLow.y}, -90);
    room.box("iron", {0.03F, 0, 0.03F}, {length - 0.03F, 0.1F, depth - 0.05F});
    room.box("green_paint", {0, 0.1F, 0}, {length, kCounter_m - 0.04F, depth - 0.02F});
    const int panels = 5;
    const float pitch = length / panels;
    for (int k = 0; k < panels; ++k) {
        const vec2 profile[] = {{0.0F, 0.0F}, {0.012F, 0.016F}, {0.045F, 0.0F}};
        room.image_frame(
            "green_paint",
            {{pitch * static_cast<float>(k) + 0.05F, 0.18F, depth - 0.02F}, {pitch - 0.1F, 0, 0}, {0, 0.62F, 0}},
            profile);
    }
    const vec2 lamp{0.42F, 0.3F};
    const vec2 doll{1.25F, 0.3F};
    const std::vector<Footprint> prints{{lamp - 0.09F, lamp + 0.09F, 0.05F, 0.5F, true},
                                        {doll - 0.09F, doll + 0.09F, 0.05F, 0.5F, true},
                                        {{1.83F, 0.18F}, {2.19F, 0.5F}, 0.06F, 0.55F}};
    const WoodTone tone{srgb(0x94643F), srgb(0x54341F)};
    const float over = 0.03F;
    room.box_with_top("walnut", "shop_counter", {-over, kCounter_m - 0.04F, -over},
                      {length + over, kCounter_m, depth + over}, 220, [&](vec2 p) {
                          const vec2 place{p.x - over, depth + over - p.y};
                          return wood(p, tone, 61) * contact_shadow(place, prints);
                      });
    room.object("lamp", {lamp.x, kCounter_m, lamp.y}, 0, 0.5F);
    room.object("doll", {doll.x, kCounter_m, doll.y}, 10, 0.34F);
    // The till: a drawer, a sloping body and keys.
    room.soft_box("walnut", {1.83F, kCounter_m, 0.18F}, {2.19F, kCounter_m + 0.09F, 0.5F}, 0.012F);
    room.soft_box("brass", {1.86F, kCounter_m + 0.09F, 0.3F}, {2.16F, kCounter_m + 0.27F, 0.44F}, 0.03F);
    room.soft_box("walnut", {1.89F, kCounter_m + 0.27F, 0.33F}, {2.13F, kCounter_m + 0.35F, 0.39F}, 0.02F);
    for (int k = 0; k < 4; ++k) {
        const float x = 1.92F + 0.06F * static_cast<float>(k);
        room.soft_box("card", {x, kCounter_m + 0.09F, 0.2F}, {x + 0.04F, kCounter_m + 0.13F, 0.27F}, 0.008F);
    }
    room.lathe("brass", {1.6F, kCounter_m, 0.42F},
               {{0.0F, 0.0F},
                {0.045F, 0.0F},
                {0.045F, 0.012F},
                {0.04F, 0.03F},
                {0.025F, 0.046F},
                {0.006F, 0.052F},
                {0.006F, 0.062F},
                {0.0F, 0.066F}},
               14, 0.7F);
    room.set_frame({0, 0, 0});
    for (const float z : {2.65F, 3.85F}) pendant(room, {2.08F, kShopHigh.y, z}, 2.0F);
}

void corners(RoomBuilder& room) {
    Random random(71);
    basket(room, {-2.6F, 0, 0.45F}, 0.24F, 0.42F, 3, random);
    basket(room, {-2.0F, 0, 0.32F}, 0.18F, 0.3F, 2, random);
    framed_painting(room, "shop_picture", {-2.35F, 1.62F, 0}, {0.9F, 0.62F}, [](vec2 p) {
        return painting_colour(Painting::birches, p / vec2{0.9F, 0.62F}, 0.9F / 0.62F, 72);
    });
    room.set_frame({1.75F, 0, 0.45F});
    room.soft_box("walnut", {-0.22F, 0.7F, -0.22F}, {0.22F, 0.74F, 0.22F}, 0.015F);
    room.lathe("walnut", {0, 0, 0},
               {{0.0F, 0.0F},
                {0.17F, 0.0F},
                {0.17F, 0.03F},
                {0.05F, 0.07F},
                {0.03F, 0.3F},
                {0.045F, 0.45F},
                {0.03F, 0.6F},
                {0.09F, 0.7F},
                {0.0F, 0.7F}},
               14, 0.7F);
    room.object("flower", {0, 0.74F, 0}, 200, 0.55F);
    room.set_frame({0, 0, 0});
}

}  // namespace

void build_shop(World& world, float texture_scale) {
    Room shop{"shop", kShopLow, kShopHigh, {}};
    shop.lights = {
        {WorldLightKind::directional, 0xFFEBD0, 0.58F, 0.48F, glm::normalize(vec3{-0.35F, -1.0F, -0.45F})},
        {WorldLightKind::directional, 0xFFE9D2, 0.30F, 0.0F, glm::normalize(vec3{0.9F, -0.15F, -0.5F})},
        {WorldLightKind::directional, 0xE8EEFF, 0.22F, 0.0F, glm::normalize(vec3{-0.6F, 0.1F, -0.8F})},
        {WorldLightKind::directional, 0xFFE0BC, 0.20F, 0.0F, glm::normalize(vec3{-0.2F, 0.9F, 0.6F})},
        {WorldLightKind::point, 0xFFD9A0, 1.0F, 0.0F, {2.08F, 1.95F, 3.25F}, 2.2F, 3.7F},
        {WorldLightKind::point, 0xFFD9A0, 0.9F, 0.0F, {-1.3F, 2.05F, 3.8F}, 2.2F, 3.7F},
    };
    world.rooms.push_back(shop);
    RoomBuilder room(world, "shop", texture_scale);
    shop_floor_and_ceiling(room);
    shop_walls(room);
    shop_window(room);
    doorway(room);
    shelves(room);
    table(room);
    counter(room);
    corners(room);
}

}  // namespace rs::synthetic
