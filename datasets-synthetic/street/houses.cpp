#include "datasets-synthetic/street/street_models.hpp"

#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/shapes/random.hpp"
#include "datasets-synthetic/showroom/painting.hpp"
#include "datasets-synthetic/street/facade.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

constexpr float kFloor_m = 3.1F;
constexpr float kGround_m = 3.7F;
constexpr float kFoundation_m = -0.3F;  // lower end of walls, below the ground
constexpr float kShopDepth_m = 1.6F;
constexpr float kLedge_m = 0.75F;

std::string wall_look(int wall) {
    return "wall_" + std::to_string(wall);
}

std::string window_look(const HouseStyle& style, Random& random) {
    const int kind = random.below(kWindowLooks);
    const bool lit = style.night && random.uniform() < 0.42F;
    return (lit ? "window_lit_" : "window_") + std::to_string(kind);
}

// Storeys above the ground floor: windows in axes, a string course, some balconies.
void upper_floors(Pen& pen, const HouseStyle& style, float top, Random& random) {
    const float w = style.width_m;
    const int across = std::max(static_cast<int>(w / 2.5F), 2);
    const float step = w / static_cast<float>(across);
    const bool surround = random.uniform() < 0.55F;
    const float balconies = surround ? 0.35F : 0.0F;
    for (int floor = 1; floor < style.floors; ++floor) {
        WallBand band{wall_look(style.wall), 0, w};
        band.low = kGround_m + kFloor_m * static_cast<float>(floor - 1);
        band.high = floor + 1 < style.floors ? band.low + kFloor_m : top;
        band.sill = band.low + 0.75F;
        band.head = band.sill + (floor == 1 ? 1.85F : floor == 2 ? 1.75F : 1.5F);
        std::vector<FacadeOpening> openings;
        for (int i = 0; i < across; ++i) {
            const float left = step * (static_cast<float>(i) + 0.5F) - 0.5F * kWindowWidth_m;
            const std::string look = window_look(style, random);
            const bool balcony = floor < 3 && random.uniform() < balconies;
            openings.push_back({left, kWindowWidth_m, look, surround, balcony});
        }
        wall_with_openings(pen, band, openings);
        if (floor == 1) pen.box("cornice", {-0.01F, band.low - 0.1F, 0}, {w + 0.01F, band.low + 0.12F, 0.09F});
    }
}

void dormer(Pen& pen, const HouseStyle& style, float x, float y, float z, Random& random) {
    const float half = 0.75F;
    const float high = 1.35F;
    const std::string roof = style.slate ? "roof_1" : "roof_0";
    pen.box("cornice", {x - half, y, z - 2.0F}, {x + half, y + high, z});
    const float low_y = y + 0.12F;
    pen.quad(window_look(style, random), {vec3{x - 0.5F, low_y, z + 0.01F},
                                          {x + 0.5F, low_y, z + 0.01F},
                                          {x + 0.5F, y + high - 0.12F, z + 0.01F},
                                          {x - 0.5F, y + high - 0.12F, z + 0.01F}});
    const float ridge = y + high + 0.6F;
    const float eaves = y + high - 0.08F;
    for (const float side : {-1.0F, 1.0F}) {
        const float edge = x + side * (half + 0.14F);
        std::array<vec3, 4> slope{
            vec3{edge, eaves, z + 0.14F}, {edge, eaves, z - 2.6F}, {x, ridge, z - 2.6F}, {x, ridge, z + 0.14F}};
        if (side < 0) std::swap(slope[0], slope[1]), std::swap(slope[2], slope[3]);
        pen.quad(roof, slope, {vec2{0, 0}, {0.7F, 0}, {0.7F, 0.25F}, {0, 0.25F}});
    }
    const vec3 tip{x, ridge - 0.06F, z + 0.02F};
    pen.quad("cornice", {vec3{x - half, eaves, z + 0.02F}, {x + half, eaves, z + 0.02F}, tip, tip});
}

void chimneys(Pen& pen, float x, float ridge, float d) {
    pen.box("chimney", {x, ridge - 1.1F, -0.5F * d - 0.35F}, {x + 0.7F, ridge + 0.85F, -0.5F * d + 0.35F});
    pen.box("cornice", {x - 0.06F, ridge + 0.85F, -0.5F * d - 0.41F}, {x + 0.76F, ridge + 0.95F, -0.5F * d + 0.41F});
    for (const float z : {-0.18F, 0.18F}) {
        pen.cylinder("chimney_pot", {.foot = {x + 0.35F, ridge + 0.95F, -0.5F * d + z},
                                     .radius = 0.12F,
                                     .length = 0.35F,
                                     .end_radius_share = 0.8F});
    }
}

void gable_roof(Pen& pen, const HouseStyle& style, float top, Random& random) {
    const float w = style.width_m;
    const float d = style.depth_m;
    const std::string look = style.slate ? "roof_1" : "roof_0";
    const float ridge = top + 0.36F * d;
    const float over = 0.35F;
    const float drop = over * 0.72F;
    const vec2 tiles{w / 4, 1.6F};
    const std::array<vec2, 4> uvs{vec2{0, 0}, {tiles.x, 0}, tiles, {0, tiles.y}};
    const float left = -0.05F;
    const float right = w + 0.05F;
    pen.quad(look,
             {vec3{left, top - drop, over}, {right, top - drop, over}, {right, ridge, -d / 2}, {left, ridge, -d / 2}},
             uvs);
    pen.quad(look,
             {vec3{right, top - drop, -d - over},
              {left, top - drop, -d - over},
              {left, ridge, -d / 2},
              {right, ridge, -d / 2}},
             uvs);
    for (const float x : {0.0F, w}) {
        std::array<vec3, 4> end{vec3{x, top, 0}, {x, top, -d}, {x, ridge, -d / 2}, {x, ridge, -d / 2}};
        if (x == 0.0F) std::swap(end[0], end[1]);
        const float t = d / kWallTile_m;
        pen.quad(wall_look(style.wall), end, {vec2{0, 0}, {t, 0}, {t / 2, 0.36F * t}, {t / 2, 0.36F * t}});
    }
    pen.cylinder("gutter", {.foot = {left, top - drop - 0.02F, over + 0.03F},
                            .axis = {1, 0, 0},
                            .radius = 0.07F,
                            .length = right - left,
                            .segments = 6});
    pen.cylinder("chimney_pot", {.foot = {left, ridge + 0.01F, -d / 2},
                                 .axis = {1, 0, 0},
                                 .radius = 0.1F,
                                 .length = right - left,
                                 .segments = 6});
    chimneys(pen, 0.7F * w, ridge, d);
    if (random.uniform() < 0.65F) {
        for (const float share : {0.3F, 0.7F}) dormer(pen, style, share * w, top + 0.55F, -0.65F, random);
    }
    cornice(pen, 0, w, top - 0.02F, 0.24F);
}

void flat_roof(Pen& pen, const HouseStyle& style, float top) {
    const float w = style.width_m;
    const float d = style.depth_m;
    pen.quad("roof_flat", {vec3{0, top, 0}, {w, top, 0}, {w, top, -d}, {0, top, -d}});
    pen.box("cornice", {0, top - 0.02F, -0.3F}, {w, top + 0.62F, 0.05F});
    cornice(pen, 0, w, top + 0.1F, 0.36F);
    pen.box("cornice", {-0.02F, top + 0.62F, -0.36F}, {w + 0.02F, top + 0.72F, 0.12F});
    // Brackets below the cornice.
    const int count = static_cast<int>(w / 0.8F);
    for (int i = 0; i < count; ++i) {
        const float x = w * (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
        pen.box("cornice", {x - 0.06F, top - 0.5F, 0}, {x + 0.06F, top - 0.29F, 0.2F});
    }
    chimneys(pen, 0.25F * w, top + 0.3F, d);
}

// Front of a house's side at a crossing, along +X from `origin`.
void side_facade(Pen& pen, vec3 origin, float turn_deg, const HouseStyle& house, float top, Random& random) {
    HouseStyle style = house;
    style.width_m = house.depth_m;
    pen.set_frame(origin, turn_deg);
    upper_floors(pen, style, top, random);
    WallBand band{wall_look(style.wall), 0, style.width_m};
    band.low = kFoundation_m;
    band.high = kGround_m;
    band.sill = 1.0F;
    band.head = 2.7F;
    std::vector<FacadeOpening> openings;
    for (const float share : {0.2F, 0.5F, 0.8F}) {
        const float left = share * style.width_m - 0.5F * kWindowWidth_m;
        openings.push_back({left, kWindowWidth_m, window_look(style, random), true, false});
    }
    wall_with_openings(pen, band, openings);
    pen.box("base_stone", {-0.06F, kFoundation_m, 0}, {style.width_m, 0.7F, 0.06F}, 4);
    if (!style.gable) cornice(pen, 0, style.width_m, top + 0.1F, 0.36F);
}

// Entrance between two windows above a base of stone.
void ground_floor(Pen& pen, const HouseStyle& style, Random& random) {
    const float w = style.width_m;
    const float door = 0.5F * w - 0.55F;
    const float door_head = 2.9F;
    const std::string wall = style.wall % 2 == 1 ? "wall_7" : wall_look(style.wall);
    const std::string door_look = "door_" + std::to_string(random.below(4));
    // Left and right of the entrance.
    for (const bool right : {false, true}) {
        WallBand band{wall, right ? door + 1.1F : 0, right ? w : door};
        band.low = kFoundation_m;
        band.high = door_head;
        band.sill = 1.0F;
        band.head = 2.7F;
        const float middle = 0.5F * (band.left + band.right);
        wall_with_openings(pen, band,
                           std::array{FacadeOpening{middle - 0.5F * kWindowWidth_m, kWindowWidth_m,
                                                    window_look(style, random), true, false}});
        pen.box("base_stone", {band.left - (right ? 0.0F : 0.02F), kFoundation_m, 0},
                {band.right + (right ? 0.02F : 0.0F), 0.7F, 0.06F}, 4);
    }
    pen.wall(wall, {0, door_head}, {w, kGround_m}, 0, kWallTile_m);
    pen.quad(door_look, {vec3{door, 0.15F, -0.2F},
                         {door + 1.1F, 0.15F, -0.2F},
                         {door + 1.1F, door_head, -0.2F},
                         {door, door_head, -0.2F}});
    for (const float x : {door, door + 1.1F}) {
        std::array<vec3, 4> side{vec3{x, 0, 0}, {x, 0, -0.2F}, {x, door_head, -0.2F}, {x, door_head, 0}};
        if (x > door) std::swap(side[0], side[1]), std::swap(side[2], side[3]);
        pen.quad("reveal", side);
    }
    pen.quad("reveal", {vec3{door, door_head, -0.2F},
                        {door + 1.1F, door_head, -0.2F},
                        {door + 1.1F, door_head, 0},
                        {door, door_head, 0}});
    pen.box("sill", {door - 0.18F, 0, 0}, {door, door_head, 0.1F});
    pen.box("sill", {door + 1.1F, 0, 0}, {door + 1.28F, door_head, 0.1F});
    pen.box("sill", {door - 0.25F, door_head, 0}, {door + 1.35F, door_head + 0.16F, 0.12F});
    pen.box("sill", {door - 0.32F, door_head + 0.16F, 0}, {door + 1.42F, door_head + 0.26F, 0.34F});
    pen.box("step", {door - 0.2F, kFoundation_m, -0.25F}, {door + 1.3F, kKerb_m + 0.16F, 0.35F});
}

// Ledge behind the shop's window with its objects on plinths.
void shop_display(World& world, Pen& pen, const HouseStyle& style, vec2 low, vec2 high) {
    const float back = -kShopDepth_m;
    pen.quad("shop_inside", {vec3{low, back}, {high.x, low.y, back}, vec3{high, back}, {low.x, high.y, back}});
    pen.quad("shop_inside", {vec3{low, 0}, {low, back}, {low.x, high.y, back}, {low.x, high.y, 0}});
    pen.quad("shop_inside", {vec3{high.x, low.y, back}, {high.x, low.y, 0}, {high, 0}, {high, back}});
    pen.quad("reveal", {vec3{low.x, high.y, back}, {high, back}, {high, 0}, {low.x, high.y, 0}});
    pen.quad("shop_floor", {vec3{low, 0}, {high.x, low.y, 0}, {high.x, low.y, back}, {low, back}});
    const std::size_t count = style.objects.size();
    for (std::size_t i = 0; i < count; ++i) {
        const float x = low.x + (high.x - low.x) * (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
        const float z = -0.75F - 0.25F * static_cast<float>(i % 2);
        const float top = low.y + kLedge_m - 0.35F;
        pen.box("plinth", {x - 0.34F, low.y, z - 0.34F}, {x + 0.34F, top, z + 0.34F});
        world.objects.push_back(
            {"", style.objects[i], pen.point({x, top, z}), 0, 1.15F / object_shape(style.objects[i]).height_radii});
    }
}

void shop_sign(Pen& pen, RoomBuilder& builder, const HouseStyle& style, float head) {
    const float w = style.width_m;
    const vec2 size{w - 0.6F, 0.62F};
    const std::string look = "sign_" + style.shop;
    const auto ink = lettering(style.shop, size, 0.56F * size.y, 0.095F * size.y);
    builder.painted_look(look, size, 110, [&](vec2 p) { return glm::mix(srgb(0x1B3A33), srgb(0xE8D9A8), ink(p)); });
    pen.box("shop_front", {0.2F, head + 0.06F, 0}, {w - 0.2F, head + 0.7F, 0.1F});
    pen.quad(look, {vec3{0.3F, head + 0.07F, 0.11F},
                    {w - 0.3F, head + 0.07F, 0.11F},
                    {w - 0.3F, head + 0.69F, 0.11F},
                    {0.3F, head + 0.69F, 0.11F}});
    cornice(pen, 0.1F, w - 0.1F, head + 0.95F, 0.3F);
}

// A shop window between pilasters with a ledge for objects, and a glass door.
void shop(World& world, Pen& pen, RoomBuilder& builder, const HouseStyle& style) {
    const float w = style.width_m;
    const float low = 0.5F;
    const float head = 2.75F;
    const float left = 0.55F;
    const float right = w - 1.9F;
    const float door = right + 0.3F;
    const float door_end = w - 0.4F;
    const std::string wall = wall_look(style.wall);
    pen.wall(wall, {0, head}, {w, kGround_m}, 0, kWallTile_m);
    for (const vec2 pier : {vec2{0, left}, {right, door}, {door_end, w}}) {
        pen.wall(wall, {pier.x, kFoundation_m}, {pier.y, head}, 0, kWallTile_m);
        const float middle = 0.5F * (pier.x + pier.y);
        const float half = 0.5F * std::min(pier.y - pier.x, 0.4F);
        pen.box("shop_front", {middle - half, kFoundation_m, 0}, {middle + half, head, 0.08F});
        pen.box("shop_front", {middle - half - 0.03F, kFoundation_m, 0}, {middle + half + 0.03F, 0.45F, 0.12F});
        pen.box("shop_front", {middle - half - 0.04F, head - 0.12F, 0}, {middle + half + 0.04F, head, 0.14F});
    }
    // Panels below the window, and its bars.
    pen.quad("shop_panel", {vec3{left, 0.02F, 0.01F}, {right, 0.02F, 0.01F}, {right, low, 0.01F}, {left, low, 0.01F}},
             {vec2{0, 0}, {std::round(right - left), 0}, {std::round(right - left), 1}, {0, 1}});
    pen.box("shop_front", {left, kFoundation_m, 0}, {right, 0.04F, 0.05F});
    pen.box("shop_front", {left - 0.05F, low - 0.05F, 0}, {right + 0.05F, low + 0.03F, 0.1F});
    pen.box("shop_front", {left, head - 0.5F, -0.03F}, {right, head - 0.44F, 0.04F});
    const int bars = std::max(static_cast<int>((right - left) / 2.2F), 1);
    for (int i = 1; i < bars; ++i) {
        const float x = left + (right - left) * static_cast<float>(i) / static_cast<float>(bars);
        pen.box("shop_front", {x - 0.03F, low, -0.03F}, {x + 0.03F, head, 0.04F});
    }
    // Door.
    pen.quad(style.night ? "window_lit_3" : "window_3",
             {vec3{door, 0.1F, -0.12F}, {door_end, 0.1F, -0.12F}, {door_end, head, -0.12F}, {door, head, -0.12F}});
    pen.box("shop_front", {door, 0.1F, -0.12F}, {door_end, 0.55F, -0.09F});
    pen.box("step", {door, kFoundation_m, -0.15F}, {door_end, kKerb_m + 0.05F, 0.25F});
    shop_display(world, pen, style, {left, low}, {right, head});
    pen.quad("shop_glass", {vec3{left, low, 0}, {right, low, 0}, {right, head, 0}, {left, head, 0}});
    shop_sign(pen, builder, style, head);
    awning(pen, left, right, head + 0.02F);
}

}  // namespace

vec3 shop_light(vec3 origin, float turn_deg, const HouseStyle& style) {
    World nowhere;
    Pen pen(nowhere, "");
    pen.set_frame(origin, turn_deg);
    return pen.point({0.5F * style.width_m - 0.7F, 2.55F, -0.55F});
}

void build_house(World& world, Pen& pen, RoomBuilder& builder, vec3 origin, float turn_deg, const HouseStyle& style) {
    Random random(style.seed, 3);
    pen.set_frame(origin, turn_deg);
    const float w = style.width_m;
    const float d = style.depth_m;
    const float top = kGround_m + kFloor_m * static_cast<float>(style.floors - 1) + 0.25F;
    const std::string wall = wall_look(style.wall);
    const auto side = [&](vec3 a, vec3 b) {
        const vec2 size = vec2{glm::distance(a, b), top - kFoundation_m} / kWallTile_m;
        const vec3 low{0, kFoundation_m, 0};
        const vec3 high{0, top, 0};
        pen.quad(wall, {a + low, b + low, b + high, a + high}, {vec2{0, 0}, {size.x, 0}, size, {0, size.y}});
    };
    side({w, 0, -d}, {0, 0, -d});
    const vec3 right = pen.point({w, 0, 0});
    const vec3 left = pen.point({0, 0, -d});
    if (style.open_right) {
        side_facade(pen, right, turn_deg + 90, style, top, random);
    } else {
        side({w, 0, 0}, {w, 0, -d});
    }
    if (style.open_left) {
        side_facade(pen, left, turn_deg - 90, style, top, random);
    } else {
        pen.set_frame(origin, turn_deg);
        side({0, 0, -d}, {0, 0, 0});
    }
    pen.set_frame(origin, turn_deg);
    if (style.shop.empty()) {
        ground_floor(pen, style, random);
    } else {
        shop(world, pen, builder, style);
    }
    upper_floors(pen, style, top, random);
    if (style.gable) {
        gable_roof(pen, style, top, random);
    } else {
        flat_roof(pen, style, top);
    }
    pen.cylinder("gutter", {.foot = {0.1F, 0.2F, 0.1F}, .radius = 0.05F, .length = top - 0.4F, .segments = 6});
}

}  // namespace rs::synthetic
