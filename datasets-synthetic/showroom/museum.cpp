#include "datasets-synthetic/showroom/showroom.hpp"

#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/noise.hpp"
#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/showroom/furniture.hpp"
#include "datasets-synthetic/showroom/painting.hpp"
#include "datasets-synthetic/showroom/room_shell.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

constexpr vec3 kLow{-5.0F, 0.0F, -9.3F};
constexpr vec3 kHigh{5.0F, 4.2F, -kWallBetween_m};
constexpr float kDado_m = 1.0F;
constexpr vec2 kSkyLow{-2.6F, -7.2F};  // x, z
constexpr vec2 kSkyHigh{2.6F, -2.4F};
constexpr float kGlass_m = 4.85F;

struct Plinth {
    const char* name;
    vec2 place;  // x, z
    float width_m;
    float height_m;
    float object_height_m;
    float facing_deg;  // orientation of the plinth's front
};
constexpr Plinth kStands[] = {
    {"lattice", {0.0F, -4.8F}, 0.72F, 0.98F, 0.74F, 0}, {"vase", {-3.4F, -2.4F}, 0.5F, 1.05F, 0.78F, 90},
    {"flower", {-3.4F, -5.4F}, 0.5F, 1.05F, 0.74F, 90}, {"lamp", {3.4F, -2.4F}, 0.5F, 1.05F, 0.84F, -90},
    {"doll", {3.4F, -5.4F}, 0.5F, 1.05F, 0.6F, -90},    {"blocks", {-2.2F, -8.1F}, 0.5F, 1.05F, 0.62F, 0},
    {"vase", {2.2F, -8.1F}, 0.5F, 1.05F, 0.84F, 0},
};

std::vector<Footprint> floor_prints() {
    std::vector<Footprint> prints;
    for (const Plinth& stand : kStands) {
        const float half = 0.5F * stand.width_m + 0.03F;
        prints.push_back({stand.place - half, stand.place + half, 0.22F, 0.55F});
    }
    prints.push_back({{-0.85F, -2.74F}, {0.85F, -2.26F}, 0.25F, 0.45F});  // the bench
    return prints;
}

void museum_floor_and_ceiling(RoomBuilder& room) {
    const vec2 size{kHigh.x - kLow.x, kHigh.z - kLow.z};
    const std::vector<Footprint> prints = floor_prints();
    const WoodTone oak{srgb(0xA88B6A), srgb(0x735A42)};
    room.painted_sheet(
        "museum_floor", {{kLow.x, 0, kHigh.z}, {size.x, 0, 0}, {0, 0, -size.y}}, 110,
        [&](vec2 p) {
            const vec2 place{kLow.x + p.x, kHigh.z - p.y};
            const float edge_m = std::min({p.x, size.x - p.x, p.y, size.y - p.y});
            const float wall = corner_shadow(edge_m, 0.4F, 0.3F);
            const float sky =
                0.74F + 0.2F * contact_shadow(place, std::vector<Footprint>{{kSkyLow, kSkyHigh, 1.6F, -0.8F, false}});
            const bool border = edge_m > 0.36F && edge_m < 0.44F;
            const vec3 field =
                edge_m < 0.4F ? planks({p.y, p.x}, 0.12F, 1.2F, oak, 82) : chevron(p, 0.6F, 0.11F, oak, 81);
            const vec3 colour = border ? srgb(0x4A3A2E) * (0.9F + 0.2F * field.x) : field;
            return colour * wall * sky * contact_shadow(place, prints);
        },
        {.specular = 0x2C2C2C, .shininess = 0.4F});
    const float h = kHigh.y;
    wall(room, "museum_ceiling", {{kLow.x, h, kLow.z}, {size.x, 0, 0}, {0, 0, size.y}}, 40,
         plaster_painter(size, srgb(0xF0EFEA), 83),
         Opening{{kSkyLow.x - kLow.x, kSkyLow.y - kLow.z}, {kSkyHigh.x - kLow.x, kSkyHigh.y - kLow.z}});
}

void skylight(RoomBuilder& room) {
    const float h = kHigh.y;
    const float rise = kGlass_m - h;
    const vec2 size = kSkyHigh - kSkyLow;
    room.look("skylight_well", {.diffuse = 0xF4F4F0, .emissive = 0x3A3C40});
    const vec3 up{0, rise, 0};
    room.sheet("skylight_well", {{kSkyLow.x, h, kSkyHigh.y}, {0, 0, -size.y}, up});
    room.sheet("skylight_well", {{kSkyHigh.x, h, kSkyLow.y}, {0, 0, size.y}, up});
    room.sheet("skylight_well", {{kSkyLow.x, h, kSkyLow.y}, {size.x, 0, 0}, up});
    room.sheet("skylight_well", {{kSkyHigh.x, h, kSkyHigh.y}, {-size.x, 0, 0}, up});
    room.painted_sheet(
        "skylight_glass", {{kSkyLow.x, kGlass_m, kSkyLow.y}, {size.x, 0, 0}, {0, 0, size.y}}, 40,
        [](vec2 p) {
            const float cloud = smooth_step(-0.3F, 0.4F, layered_noise({p.x * 0.6F, p.y * 0.6F, 0.0F}, 4, 84));
            return srgb(0xC4D8EA) * (1.0F - cloud) + srgb(0xFFFFFF) * cloud;
        },
        {.emissive = 0x9AA8B4});
    for (int k = 0; k <= 4; ++k) {
        const float x = kSkyLow.x + (size.x - 0.06F) * static_cast<float>(k) / 4.0F;
        room.box("white_paint", {x, kGlass_m - 0.08F, kSkyLow.y + 0.01F},
                 {x + 0.06F, kGlass_m - 0.002F, kSkyHigh.y - 0.01F});
    }
    for (int k = 0; k <= 4; ++k) {
        const float z = kSkyLow.y + (size.y - 0.05F) * static_cast<float>(k) / 4.0F;
        room.box("white_paint", {kSkyLow.x + 0.01F, kGlass_m - 0.06F, z},
                 {kSkyHigh.x - 0.01F, kGlass_m - 0.004F, z + 0.05F});
    }
    const vec2 profile[] = {{0.0F, 0.0F}, {0.02F, 0.05F}, {0.09F, 0.07F}, {0.13F, 0.02F}, {0.14F, 0.0F}};
    room.image_frame("white_paint",
                     {{kSkyLow.x - 0.14F, h, kSkyLow.y - 0.14F}, {size.x + 0.28F, 0, 0}, {0, 0, size.y + 0.28F}},
                     profile);
}

// Baked light of a skylight and picture lamps on a wall: brighter at the height of the paintings.
Painter museum_wall(vec2 size_m, std::uint32_t seed) {
    const Painter plain = plaster_painter(size_m, srgb(0x93A79F), seed);
    return [=](vec2 p) {
        const float glow = 1.0F - smooth_step(0.3F, 2.1F, std::abs(p.y - 2.1F));
        return plain(p) * (0.84F + 0.24F * glow);
    };
}

// Panels below the dado rail along a wall, in a frame whose x runs along the wall from 0 to `length_m`.
void panels(RoomBuilder& room, float from_m, float to_m) {
    const int count = std::max(1, static_cast<int>(std::lround((to_m - from_m) / 1.2F)));
    const float pitch = (to_m - from_m) / static_cast<float>(count);
    for (int k = 0; k < count; ++k) {
        const float left = from_m + pitch * static_cast<float>(k) + 0.08F;
        const vec2 profile[] = {{0.0F, 0.0F}, {0.012F, 0.018F}, {0.045F, 0.0F}};
        room.image_frame("dado", {{left, 0.24F, 0}, {pitch - 0.16F, 0, 0}, {0, kDado_m - 0.36F, 0}}, profile);
    }
}

void museum_walls(RoomBuilder& room) {
    const float width = kHigh.x - kLow.x;
    const float depth = kHigh.z - kLow.z;
    room.look("dado", {.diffuse = 0x55675F, .specular = 0x161616, .shininess = 0.3F});
    struct Side {
        const char* name;
        vec3 origin;
        float turn_deg;
        float length_m;
        bool door;
    };
    const Side sides[] = {{"museum_wall_end", {kLow.x, 0, kLow.z}, 0, width, false},
                          {"museum_wall_left", {kLow.x, 0, kHigh.z}, 90, depth, false},
                          {"museum_wall_right", {kHigh.x, 0, kLow.z}, -90, depth, false},
                          {"museum_wall_door", {kHigh.x, 0, kHigh.z}, 180, width, true}};
    for (std::size_t k = 0; k < 4; ++k) {
        const Side& side = sides[k];
        room.set_frame(side.origin, side.turn_deg);
        const float length = side.length_m;
        const auto seed = static_cast<std::uint32_t>(90 + k);
        const float door_low = 0.5F * length - kDoorHalf_m;
        const float door_high = 0.5F * length + kDoorHalf_m;
        const float upper = kHigh.y - kDado_m;
        const Painter paint = museum_wall({length, kHigh.y}, seed);
        const Painter lower = [&](vec2 p) {
            const float edges =
                corner_shadow(std::min(p.x, length - p.x), 0.3F, 0.25F) * corner_shadow(p.y, 0.25F, 0.35F);
            return plaster(p, srgb(0x55675F), seed + 10) * edges * corner_shadow(kDado_m - p.y, 0.08F, 0.3F);
        };
        const SheetFrame above{{0, kDado_m, 0}, {length, 0, 0}, {0, upper, 0}};
        const SheetFrame below{{0, 0, 0}, {length, 0, 0}, {0, kDado_m, 0}};
        const Painter raised = [&](vec2 p) { return paint(p + vec2{0, kDado_m}); };
        if (side.door) {
            wall(room, side.name, above, 50, raised, Opening{{door_low, 0}, {door_high, kDoorHeight_m - kDado_m}});
            wall(room, side.name + std::string("_dado"), below, 50, lower,
                 Opening{{door_low, 0}, {door_high, kDado_m}});
            panels(room, 0.1F, door_low - 0.14F);
            panels(room, door_high + 0.14F, length - 0.1F);
            room.box("white_paint", {door_low - 0.14F, 0, 0}, {door_low, kDoorHeight_m + 0.14F, 0.05F});
            room.box("white_paint", {door_high, 0, 0}, {door_high + 0.14F, kDoorHeight_m + 0.14F, 0.05F});
            room.box("white_paint", {door_low, kDoorHeight_m, 0}, {door_high, kDoorHeight_m + 0.14F, 0.05F});
            room.soft_box("white_paint", {door_low - 0.2F, kDoorHeight_m + 0.14F, 0},
                          {door_high + 0.2F, kDoorHeight_m + 0.22F, 0.11F}, 0.02F);
        } else {
            wall(room, side.name, above, 50, raised);
            wall(room, side.name + std::string("_dado"), below, 50, lower);
            panels(room, 0.1F, length - 0.1F);
        }
    }
    room.set_frame({0, 0, 0});
    const MouldingGap door{-kDoorHalf_m - 0.14F, kDoorHalf_m + 0.14F, true};
    moulding(room, "dado", kLow, {kHigh.x, 0.16F, kHigh.z}, 0.03F, door);
    moulding(room, "dado", {kLow.x, kDado_m - 0.03F, kLow.z}, {kHigh.x, kDado_m + 0.03F, kHigh.z}, 0.045F, door);
    moulding(room, "white_paint", {kLow.x, kHigh.y - 0.1F, kLow.z}, kHigh, 0.16F);
    moulding(room, "white_paint", {kLow.x, kHigh.y - 0.2F, kLow.z}, {kHigh.x, kHigh.y - 0.1F, kHigh.z}, 0.09F);
    moulding(room, "white_paint", {kLow.x, kHigh.y - 0.25F, kLow.z}, {kHigh.x, kHigh.y - 0.2F, kHigh.z}, 0.04F);
}

void images(RoomBuilder& room) {
    struct Hung {
        const char* name;
        Painting painting;
        vec3 origin;  // of the wall
        float turn_deg;
        float x_m;  // along the wall
        vec2 size_m;
    };
    const Hung hung[] = {
        {"painting_hills", Painting::hills, {kLow.x, 0, kLow.z}, 0, 5.0F, {2.3F, 1.35F}},
        {"painting_sea", Painting::sea, {kLow.x, 0, kHigh.z}, 90, 3.6F, {1.5F, 1.05F}},
        {"painting_fields", Painting::fields, {kLow.x, 0, kHigh.z}, 90, 6.9F, {1.1F, 1.1F}},
        {"painting_circles", Painting::circles, {kHigh.x, 0, kLow.z}, -90, 5.4F, {1.4F, 1.1F}},
        {"painting_birches", Painting::birches, {kHigh.x, 0, kLow.z}, -90, 2.0F, {0.95F, 1.25F}},
    };
    std::uint32_t seed = 301;
    for (const Hung& one : hung) {
        room.set_frame(one.origin, one.turn_deg);
        const vec2 size = one.size_m;
        framed_painting(room, one.name, {one.x_m, 2.05F, 0}, size,
                        [&](vec2 p) { return painting_colour(one.painting, p / size, size.x / size.y, seed); });
        // The lamp above it.
        const float top = 2.05F + 0.5F * size.y + 0.09F;
        room.box("brass", {one.x_m - 0.008F, top + 0.08F, 0.0F}, {one.x_m + 0.008F, top + 0.1F, 0.18F});
        room.box("brass", {one.x_m - 0.22F, top + 0.07F, 0.18F}, {one.x_m + 0.22F, top + 0.11F, 0.22F});
        ++seed;
    }
    room.set_frame({0, 0, 0});
}

}  // namespace

void build_museum(World& world, float texture_scale) {
    Room museum{"museum", kLow, kHigh, {}};
    museum.lights = {
        {WorldLightKind::directional, 0xF4F7FF, 0.60F, 0.58F, glm::normalize(vec3{0.12F, -1.0F, -0.2F})},
        {WorldLightKind::directional, 0xFFF4E6, 0.26F, 0.0F, glm::normalize(vec3{-0.9F, -0.25F, -0.45F})},
        {WorldLightKind::directional, 0xEAF1FF, 0.34F, 0.0F, glm::normalize(vec3{0.75F, -0.2F, -0.7F})},
        {WorldLightKind::directional, 0xFFF6EC, 0.24F, 0.0F, glm::normalize(vec3{0.1F, 0.75F, 0.7F})},
    };
    world.rooms.push_back(museum);
    RoomBuilder room(world, "museum", texture_scale);
    museum_floor_and_ceiling(room);
    skylight(room);
    museum_walls(room);
    images(room);
    int number = 0;
    for (const Plinth& stand : kStands) {
        room.set_frame({stand.place.x, 0, stand.place.y}, stand.facing_deg);
        plinth(room, "plinth" + std::to_string(number++), stand.name, stand.width_m, stand.height_m,
               stand.object_height_m);
    }
    room.set_frame({0, 0, 0});
    const vec3 around[] = {{-1.1F, 0, -3.7F}, {1.1F, 0, -3.7F}, {1.1F, 0, -5.9F}, {-1.1F, 0, -5.9F}};
    rope_barrier(room, around, true);
    const vec3 before[] = {{-1.2F, 0, -8.4F}, {1.2F, 0, -8.4F}};
    rope_barrier(room, before, false);
    room.set_frame({0, 0, -2.5F});
    bench(room, 1.7F);
    room.set_frame({0, 0, 0});
}

}  // namespace rs::synthetic
