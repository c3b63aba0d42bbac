#include "datasets-synthetic/street/street_models.hpp"

#include "datasets-synthetic/shapes/noise.hpp"
#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/shapes/random.hpp"
#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

constexpr float kFloor_m = 3.1F;
constexpr float kGround_m = 3.7F;
constexpr float kTile_m = 2;  // size of the wall textures
constexpr float kShopDepth_m = 1.6F;
constexpr float kLedge_m = 0.75F;

std::string wall_look(int wall) {
    return "wall_" + std::to_string(wall);
}

vec3 brick(vec2 p, vec3 colour, std::uint32_t seed) {
    constexpr vec2 kBrick{0.25F, 0.0833333F};
    const float row = std::floor(p.y / kBrick.y);
    const float shift = static_cast<int>(row) % 2 == 0 ? 0.0F : 0.5F;
    const float across = p.x / kBrick.x + shift;
    const vec2 within{(across - std::floor(across)) * kBrick.x, p.y - row * kBrick.y};
    const bool mortar = within.x < 0.012F || within.y < 0.012F;
    const auto column = static_cast<int>(std::floor(across)) % 8;
    const float tone =
        0.75F + 0.4F * static_cast<float>(lattice_hash(column, static_cast<int>(row), 0, seed) >> 8U) / 16777216.0F;
    return mortar ? vec3(0.38F, 0.36F, 0.33F) : colour * tone;
}

vec3 plaster_wall(vec2 p, vec3 colour, std::uint32_t seed) {
    return colour * (0.94F + 0.08F * layered_noise({p * 3.0F, 0.5F}, 3, seed));
}

// A window frame with a cross, and behind it a lit room or the sky's reflection.
vec3 window_image(vec2 share, bool lit, int kind) {
    const float frame = 0.05F;
    const bool in_frame = share.x < frame || share.x > 1 - frame || share.y < 0.6F * frame ||
                          share.y > 1 - 0.6F * frame || std::abs(share.x - 0.5F) < 0.5F * frame ||
                          std::abs(share.y - 0.68F) < 0.3F * frame;
    if (in_frame) return lit ? vec3(0.42F, 0.36F, 0.28F) : vec3(0.78F, 0.77F, 0.74F);
    const float fold = 0.5F + 0.5F * static_cast<float>(portable::sin(static_cast<double>(share.x) * 60.0));
    const bool curtain = kind == 1 ? std::abs(share.x - 0.5F) > 0.27F : kind == 2 && share.y > 0.45F;
    if (lit) {
        const vec3 room = glm::mix(vec3(0.75F, 0.46F, 0.17F), vec3(1.0F, 0.74F, 0.36F), share.y);
        return curtain ? vec3(0.8F, 0.42F, 0.2F) * (0.5F + 0.3F * fold) : room;
    }
    const vec3 sky = glm::mix(vec3(0.03F, 0.04F, 0.05F), vec3(0.16F, 0.22F, 0.29F), share.y * share.y);
    return curtain ? vec3(0.42F, 0.4F, 0.36F) * (0.6F + 0.3F * fold) : sky;
}

// Letters on a board, almost as high as the board.
vec3 sign_image(vec2 p, vec2 size, const std::string& text, vec3 board, vec3 ink) {
    const float height = 0.56F * size.y;
    float width = 0;
    for (const char c : text) width += (pen_letter(c).width + 0.22F) * height;
    float x = 0.5F * (size.x - width) + 0.11F * height;
    const float base = 0.22F * size.y;
    for (const char c : text) {
        const Letter letter = pen_letter(c);
        for (const auto& stroke : letter.strokes) {
            for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
                const vec2 a = vec2{x, base} + height * stroke[i];
                const vec2 b = vec2{x, base} + height * stroke[i + 1];
                const vec2 way = b - a;
                const float t = std::clamp(glm::dot(p - a, way) / std::max(glm::dot(way, way), 1e-8F), 0.0F, 1.0F);
                if (glm::distance(p, a + t * way) < 0.085F * height) return ink;
            }
        }
        x += (letter.width + 0.22F) * height;
    }
    return board;
}

void window(Pen& pen, vec2 low, vec2 high, float z, const std::string& look) {
    pen.quad(look, {vec3{low.x, low.y, z + 0.015F},
                    {high.x, low.y, z + 0.015F},
                    {high.x, high.y, z + 0.015F},
                    {low.x, high.y, z + 0.015F}});
    pen.box("sill", {low.x - 0.08F, low.y - 0.09F, z}, {high.x + 0.08F, low.y, z + 0.14F});
    pen.box("sill", {low.x - 0.06F, high.y, z}, {high.x + 0.06F, high.y + 0.12F, z + 0.06F});
}

std::string window_look(const HouseStyle& style, Random& random) {
    const int kind = random.below(3);
    const bool lit = style.night && random.uniform() < 0.42F;
    return (lit ? "window_lit_" : "window_") + std::to_string(kind);
}

void windows_of_floors(Pen& pen, const HouseStyle& style, Random& random) {
    const int across = std::max(static_cast<int>(style.width_m / 2.7F), 2);
    const float step = style.width_m / static_cast<float>(across);
    for (int floor = 1; floor < style.floors; ++floor) {
        const float sill = kGround_m + kFloor_m * static_cast<float>(floor - 1) + 0.85F;
        for (int i = 0; i < across; ++i) {
            const float x = step * (static_cast<float>(i) + 0.5F);
            window(pen, {x - 0.55F, sill}, {x + 0.55F, sill + 1.65F}, 0, window_look(style, random));
        }
    }
}

void roof(Pen& pen, const HouseStyle& style, float top) {
    const float w = style.width_m;
    const float d = style.depth_m;
    if (!style.gable) {
        pen.quad("roof_flat", {vec3{0, top, 0}, {w, top, 0}, {w, top, -d}, {0, top, -d}});
        pen.box("cornice", {-0.1F, top - 0.15F, -0.3F}, {w + 0.1F, top + 0.55F, 0.16F});
        return;
    }
    const float ridge = top + 0.36F * d;
    const float over = 0.35F;
    const float drop = over * 0.72F;
    pen.quad("roof",
             {vec3{-0.05F, top - drop, over},
              {w + 0.05F, top - drop, over},
              {w + 0.05F, ridge, -d / 2},
              {-0.05F, ridge, -d / 2}},
             {vec2{0, 0}, {w / 2, 0}, {w / 2, 3}, {0, 3}});
    pen.quad("roof",
             {vec3{w + 0.05F, top - drop, -d - over},
              {-0.05F, top - drop, -d - over},
              {-0.05F, ridge, -d / 2},
              {w + 0.05F, ridge, -d / 2}},
             {vec2{0, 0}, {w / 2, 0}, {w / 2, 3}, {0, 3}});
    for (const float x : {0.0F, w}) {
        std::array<vec3, 4> end{vec3{x, top, 0}, {x, top, -d}, {x, ridge, -d / 2}, {x, ridge, -d / 2}};
        if (x == 0.0F) std::swap(end[0], end[1]);
        pen.quad(wall_look(style.wall), end, {vec2{0, 0}, {d / kTile_m, 0}, {d / 4, 1.8F}, {d / 4, 1.8F}});
    }
    pen.box("chimney", {0.7F * w, ridge - 1.1F, -0.5F * d - 0.35F},
            {0.7F * w + 0.7F, ridge + 0.75F, -0.5F * d + 0.35F});
    pen.box("cornice", {-0.06F, top - 0.3F, 0}, {w + 0.06F, top - 0.06F, 0.22F});
}

void ground_floor(Pen& pen, const HouseStyle& style, Random& random) {
    const float w = style.width_m;
    pen.wall(wall_look(style.wall), {0, 0}, {w, kGround_m}, 0, kTile_m);
    const float door = 0.5F * w - 0.55F;
    pen.box("door_" + std::to_string(random.below(3)), {door, 0, 0}, {door + 1.1F, 2.35F, 0.04F});
    pen.box("sill", {door - 0.14F, 0, 0}, {door, 2.5F, 0.1F});
    pen.box("sill", {door + 1.1F, 0, 0}, {door + 1.24F, 2.5F, 0.1F});
    pen.box("sill", {door - 0.2F, 2.35F, 0}, {door + 1.3F, 2.6F, 0.3F});
    pen.box("step", {door - 0.2F, 0, 0}, {door + 1.3F, 0.14F, 0.4F});
    for (const float x : {0.22F * w, 0.78F * w}) {
        window(pen, {x - 0.6F, 0.95F}, {x + 0.6F, 2.7F}, 0, window_look(style, random));
    }
}

// A shop window between pillars with a ledge for objects.
void shop(World& world, Pen& pen, RoomBuilder& builder, const HouseStyle& style) {
    const float w = style.width_m;
    const float low = 0.45F;
    const float head = 2.75F;
    const float left = 0.5F;
    const float right = w - 1.9F;
    const float back = -kShopDepth_m;
    const std::string wall = wall_look(style.wall);
    pen.wall(wall, {0, head}, {w, kGround_m}, 0, kTile_m);
    pen.wall(wall, {0, 0}, {left, head}, 0, kTile_m);
    pen.wall("shop_front", {left, 0}, {right, low}, 0, kTile_m);
    pen.wall("shop_front", {right, 0}, {right + 0.3F, head}, 0, kTile_m);
    pen.wall(wall, {w - 0.35F, 0}, {w, head}, 0, kTile_m);
    // Glass door.
    const float door = right + 0.3F;
    pen.wall(style.night ? "window_lit_0" : "window_0", {door, 0.1F}, {w - 0.35F, head}, -0.05F, w - 0.35F - door);
    pen.box("step", {door, 0, -0.05F}, {w - 0.35F, 0.1F, 0.3F});
    // Interior.
    pen.quad("shop_inside", {vec3{left, low, back}, {right, low, back}, {right, head, back}, {left, head, back}});
    pen.quad("shop_inside", {vec3{left, low, 0}, {left, low, back}, {left, head, back}, {left, head, 0}});
    pen.quad("shop_inside", {vec3{right, low, back}, {right, low, 0}, {right, head, 0}, {right, head, back}});
    pen.quad("shop_inside", {vec3{left, head, back}, {right, head, back}, {right, head, 0}, {left, head, 0}});
    pen.quad("shop_floor", {vec3{left, low, 0}, {right, low, 0}, {right, low, back}, {left, low, back}});
    const std::size_t count = style.objects.size();
    for (std::size_t i = 0; i < count; ++i) {
        const float x = left + (right - left) * (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
        const float z = -0.75F - 0.25F * static_cast<float>(i % 2);
        pen.box("plinth", {x - 0.34F, low, z - 0.34F}, {x + 0.34F, low + kLedge_m - 0.35F, z + 0.34F});
        world.objects.push_back({"", style.objects[i], pen.point({x, low + kLedge_m - 0.35F, z}), 0,
                                 1.15F / object_shape(style.objects[i]).height_radii});
    }
    pen.quad("shop_glass", {vec3{left, low, 0}, {right, low, 0}, {right, head, 0}, {left, head, 0}});
    pen.box("shop_front", {left - 0.1F, low - 0.08F, 0}, {right + 0.1F, low, 0.12F});
    // Sign.
    const vec2 size{w - 0.6F, 0.62F};
    const std::string look = "sign_" + style.shop;
    builder.painted_look(look, size, 90,
                         [&](vec2 p) { return sign_image(p, size, style.shop, srgb(0x1F3A34), srgb(0xE8D9A8)); });
    pen.box("shop_front", {0.3F, head + 0.06F, 0}, {w - 0.3F, head + 0.68F, 0.08F});
    pen.quad(look, {vec3{0.3F, head + 0.06F, 0.09F},
                    {w - 0.3F, head + 0.06F, 0.09F},
                    {w - 0.3F, head + 0.68F, 0.09F},
                    {0.3F, head + 0.68F, 0.09F}});
    // Awning.
    pen.quad("awning",
             {vec3{left, head - 0.12F, 0.95F},
              {right, head - 0.12F, 0.95F},
              {right, head + 0.05F, 0.06F},
              {left, head + 0.05F, 0.06F}},
             {vec2{0, 0}, {right - left, 0}, {right - left, 1}, {0, 1}});
    pen.quad("awning",
             {vec3{left, head - 0.34F, 0.96F},
              {right, head - 0.34F, 0.96F},
              {right, head - 0.12F, 0.95F},
              {left, head - 0.12F, 0.95F}},
             {vec2{0, 0}, {right - left, 0}, {right - left, 0.2F}, {0, 0.2F}});
}

}  // namespace

void add_house_looks(RoomBuilder& builder, bool night, std::set<std::string>& unlit) {
    const std::array<std::uint32_t, kWallLooks> colours{0x9A5240, 0xD8C9A6, 0xB9745A, 0xC7CBC4, 0xE2D9C6, 0x7F4A3E};
    for (int i = 0; i < kWallLooks; ++i) {
        const vec3 colour = srgb(colours.at(static_cast<std::size_t>(i)));
        const auto seed = static_cast<std::uint32_t>(i + 11);
        const bool bricks = i % 2 == 0 ? i != 4 : i == 5;
        builder.painted_look(wall_look(i), {kTile_m, kTile_m}, 96,
                             [&](vec2 p) { return bricks ? brick(p, colour, seed) : plaster_wall(p, colour, seed); });
    }
    for (int kind = 0; kind < 3; ++kind) {
        for (const bool lit : {false, true}) {
            if (lit && !night) continue;
            const std::string name = (lit ? "window_lit_" : "window_") + std::to_string(kind);
            const Look look{.specular = lit ? 0x000000U : 0x707070U, .shininess = 0.5F};
            builder.painted_look(
                name, {1, 1.5F}, 80,
                [&](vec2 p) {
                    return window_image(p / vec2{1, 1.5F}, lit, kind);
                },
                look);
            if (lit) unlit.insert(name);
        }
    }
    builder.painted_look("roof", {2, 2}, 80, [](vec2 p) {
        const float row = p.y * 4;
        const float in_row = row - std::floor(row);
        const float column = p.x * 4 + 0.5F * static_cast<float>(static_cast<int>(std::floor(row)) % 2);
        const float in_column = column - std::floor(column);
        const float edge = std::min({in_row * 4, in_column * 6, 1.0F});
        return srgb(0x7E4234) * (0.55F + 0.45F * edge) * (0.9F + 0.2F * in_row);
    });
    builder.painted_look("awning", {1, 1}, 48,
                         [](vec2 p) { return std::fmod(p.x, 0.5F) < 0.25F ? srgb(0xA6362C) : srgb(0xE9E2D0); });
    builder.look("sill", {.diffuse = 0xD9D5CB});
    builder.look("cornice", {.diffuse = 0xCFC9BB});
    builder.look("chimney", {.diffuse = 0x8A4A3A});
    builder.look("roof_flat", {.diffuse = 0x55585A});
    builder.look("step", {.diffuse = 0xA9A59C});
    builder.look("door_0", {.diffuse = 0x27483A, .specular = 0x303030, .shininess = 0.3F});
    builder.look("door_1", {.diffuse = 0x5A2A22, .specular = 0x303030, .shininess = 0.3F});
    builder.look("door_2", {.diffuse = 0x22344E, .specular = 0x303030, .shininess = 0.3F});
    builder.look("shop_front", {.diffuse = 0x2A3B37, .specular = 0x303030, .shininess = 0.3F});
    builder.look("shop_inside", {.diffuse = 0xEADFC8});
    builder.look("shop_floor", {.diffuse = 0xA08A68});
    builder.look("plinth", {.diffuse = 0xF2EEE4});
    builder.look("shop_glass", {.diffuse = 0xB8C8D0, .specular = 0x909090, .shininess = 0.9F});
}

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
    pen.wall(wall, {0, kGround_m}, {w, top}, 0, kTile_m);
    const auto side = [&](vec3 a, vec3 b) {
        const float length = glm::distance(a, b) / kTile_m;
        pen.quad(wall, {a, b, b + vec3{0, top, 0}, a + vec3{0, top, 0}},
                 {vec2{0, 0}, {length, 0}, {length, top / kTile_m}, {0, top / kTile_m}});
    };
    side({w, 0, 0}, {w, 0, -d});
    side({w, 0, -d}, {0, 0, -d});
    side({0, 0, -d}, {0, 0, 0});
    if (style.shop.empty()) {
        ground_floor(pen, style, random);
    } else {
        shop(world, pen, builder, style);
    }
    windows_of_floors(pen, style, random);
    roof(pen, style, top);
}

}  // namespace rs::synthetic
