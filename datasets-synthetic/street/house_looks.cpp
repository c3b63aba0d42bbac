#include "datasets-synthetic/street/street_models.hpp"

#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/shapes/portable_math.hpp"
#include "datasets-synthetic/street/surface_patterns.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

constexpr vec2 kWindow_m{kWindowWidth_m, 1.75F};
constexpr vec2 kDoor_m{1.1F, 2.75F};  // with the fanlight

enum class WallKind { kBrick, kPlaster, kAshlar };
struct WallStyle {
    WallKind kind;
    std::uint32_t colour;
};
constexpr std::array<WallStyle, kWallLooks> kWalls{{{WallKind::kBrick, 0x96503E},
                                                    {WallKind::kPlaster, 0xDCC596},
                                                    {WallKind::kBrick, 0xB07A58},
                                                    {WallKind::kPlaster, 0xB9C4BC},
                                                    {WallKind::kPlaster, 0xE6DECE},
                                                    {WallKind::kBrick, 0x74453A},
                                                    {WallKind::kPlaster, 0xD59F7E},
                                                    {WallKind::kAshlar, 0xC9BA9C}}};

vec3 wall_colour(vec2 p, const WallStyle& wall, std::uint32_t seed) {
    const vec3 colour = srgb(wall.colour);
    const float stains = 1 + 0.3F * tiling_noise(p, kWallTile_m, 1, 4, seed);
    switch (wall.kind) {
        case WallKind::kBrick:
            return stains * brick_colour(p, colour, seed);
        case WallKind::kAshlar:
            return stains * block_colour(p, {0.8F, 0.4F}, 0.012F, colour, 0.16F, seed);
        case WallKind::kPlaster:
            break;
    }
    return colour * stains * (1 + 0.1F * tiling_noise(p, kWallTile_m, 12, 3, seed + 7));
}

// Reflection of the sky over the opposite houses in one pane, and the dark room behind it.
vec3 day_glass(vec2 share, int kind, int pane) {
    const float tone = 0.7F + 0.6F * hash_share(pane, kind, 17);
    const float lean = 0.09F * (hash_share(pane, kind, 23) - 0.5F);
    const float skyline = 0.4F + lean + (share.x > 0.35F && share.x < 0.75F ? 0.12F : 0.0F);
    const float sky = smooth_step(skyline - 0.015F, skyline + 0.015F, share.y);
    const vec3 house = vec3(0.035F, 0.033F, 0.03F) * tone;
    const vec3 air = glm::mix(vec3(0.2F, 0.23F, 0.26F), vec3(0.09F, 0.14F, 0.22F), share.y) * tone;
    return glm::mix(house, air, sky);
}

vec3 night_glass(vec2 share) {
    return glm::mix(vec3(0.75F, 0.46F, 0.17F), vec3(1.0F, 0.74F, 0.36F), share.y);
}

// Curtains at the sides, a net curtain, a blind, or none: colour, and opacity in `opacity`.
vec3 curtain(vec2 share, int kind, float& opacity) {
    const float fold = 0.5F + 0.5F * portable::sin(share.x * 55 + 3 * portable::sin(share.y * 2));
    const float drape = 0.16F + 0.07F * (1 - share.y) * (1 - share.y);
    opacity = 0;
    if (kind == 0 && std::min(share.x, 1 - share.x) < drape) opacity = 0.75F;
    if (kind == 1) opacity = 0.55F;
    if (kind == 2 && share.y > 0.55F) opacity = 0.9F;
    if (kind == 4 && share.y < 0.42F) opacity = 0.6F;
    if (kind == 2) return vec3(0.5F, 0.47F, 0.4F) * (std::fmod(share.y * 30, 1.0F) < 0.15F ? 0.75F : 1.0F);
    return vec3(0.42F, 0.41F, 0.38F) * (0.55F + 0.45F * fold);
}

// A casement window: outer frame, two sashes, and lights above a transom.
vec3 window_colour(vec2 p, bool lit, int kind) {
    const vec2 share = p / kWindow_m;
    constexpr float kTransom_m = 1.24F;
    const float from_edge = std::min({p.x, kWindow_m.x - p.x, p.y, kWindow_m.y - p.y});
    const float from_mullion = std::abs(p.x - 0.5F * kWindow_m.x);
    const float from_transom = std::abs(p.y - kTransom_m);
    const float from_bar = std::min({from_edge - 0.045F, from_mullion - 0.025F, from_transom - 0.03F});
    const vec3 white = lit ? vec3(0.3F, 0.25F, 0.18F) : kind == 3 ? srgb(0x3B4A44) : srgb(0xE9E6DE);
    if (from_bar < 0) return white * (from_bar > -0.008F ? 0.7F : 1.0F);  // rounded edges
    if (from_bar < 0.045F) return white * (from_bar > 0.036F ? 0.62F : 0.9F);
    const int pane = (p.x > 0.5F * kWindow_m.x ? 1 : 0) + (p.y > kTransom_m ? 2 : 0);
    float opacity = 0;
    const vec3 cloth = curtain(share, kind, opacity);
    const vec3 glass = lit ? night_glass(share) : day_glass(share, kind, pane);
    // The frame's shadow on the glass.
    const float shade = lit ? 1.0F : 0.55F + 0.45F * smooth_step(0.045F, 0.11F, from_bar);
    const vec3 cloth_light = lit ? vec3(0.85F, 0.5F, 0.25F) : vec3(0.55F);
    return shade * glm::mix(glass, cloth * cloth_light + 0.5F * glass, lit ? 0.8F * opacity : opacity);
}

vec3 door_colour(vec2 p, vec3 paint, bool lit) {
    constexpr float kLeaf_m = 2.2F;
    if (p.y > kLeaf_m) {  // fanlight
        const float frame = std::min({p.x, kDoor_m.x - p.x, p.y - kLeaf_m, kDoor_m.y - p.y});
        if (frame < 0.06F || std::abs(p.x - 0.55F) < 0.02F) return srgb(0xE9E6DE) * 0.9F;
        return lit ? night_glass({0.5F, 0.6F}) : day_glass({p.x, 0.3F + p.y - kLeaf_m}, 1, 0);
    }
    const vec2 cell{std::fmod(p.x, 0.55F), p.y < 0.85F ? p.y : p.y - 0.85F};
    const vec2 size{0.55F, p.y < 0.85F ? 0.85F : 1.35F};
    const float inside = std::min({cell.x - 0.09F, size.x - 0.09F - cell.x, cell.y - 0.1F, size.y - 0.1F - cell.y});
    const bool upper = cell.y > 0.5F * size.y;
    const float relief = inside > 0 && inside < 0.03F ? (upper ? 0.55F : 1.4F) : 1.0F;
    if (glm::distance(p, vec2{0.95F, 1.02F}) < 0.035F) return srgb(0xD9B45A);
    const float grain = tiling_noise({p.x * 8, p.y}, kWallTile_m, 3, 2, 15);
    return paint * relief * (1 + 0.2F * grain) * (0.75F + 0.25F * smooth_step(0, 0.4F, p.y));
}

vec3 roof_colour(vec2 p, vec3 colour, std::uint32_t seed) {
    const float row = p.y * 5;
    const float in_row = row - std::floor(row);
    const float column = p.x * 5 + 0.5F * static_cast<float>(static_cast<int>(std::floor(row)) % 2);
    const float in_column = column - std::floor(column);
    const float tone = hash_share(static_cast<int>(column) % 20, static_cast<int>(row) % 20, seed);
    const float edge = std::min({1.0F, in_row * 6 + 0.25F, std::min(in_column, 1 - in_column) * 10 + 0.35F});
    const float moss = std::max(tiling_noise(p, 4, 1, 4, seed), 0.0F);
    const vec3 tile = colour * (0.72F + 0.5F * tone) * edge * (1.08F - 0.25F * in_row);
    return glm::mix(tile, vec3(0.07F, 0.075F, 0.05F), std::min(1.2F * moss, 0.6F));
}

// Wrought-iron bars with scrolls, one metre wide and high; transparent between them.
Image<Rgba8> railing_image(float scale) {
    const int side = std::max(static_cast<int>(128 * scale), 16);
    Image<Rgba8> image(side, side, Rgba8{26, 28, 30, 0});
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const vec2 p = (vec2{static_cast<float>(x), static_cast<float>(side - y)} + vec2{0.5F, -0.5F}) /
                           static_cast<float>(side);
            const float cell = std::fmod(p.x, 0.125F) - 0.0625F;
            const float ring = std::abs(glm::length(vec2{cell, p.y - 0.5F}) - 0.045F);
            const bool iron =
                std::abs(cell) < 0.013F || p.y > 0.94F || p.y < 0.05F || ring < 0.014F || std::abs(p.y - 0.8F) < 0.014F;
            if (iron) image(x, y).a = 255;
        }
    }
    return image;
}

void add_window_looks(RoomBuilder& builder, bool night, std::set<std::string>& unlit) {
    for (int kind = 0; kind < kWindowLooks; ++kind) {
        for (const bool lit : {false, true}) {
            if (lit && !night) continue;
            const std::string name = (lit ? "window_lit_" : "window_") + std::to_string(kind);
            const Look look{.specular = lit ? 0x000000U : 0xA0A0A0U, .shininess = 1};
            builder.painted_look(
                name, kWindow_m, 180, [&](vec2 p) { return window_colour(p, lit, kind); }, look);
            if (lit) unlit.insert(name);
        }
    }
    const std::array<std::uint32_t, 4> doors{0x1F4A38, 0x6A241E, 0x1E3556, 0x3A2A20};
    for (std::size_t i = 0; i < doors.size(); ++i) {
        const vec3 paint = srgb(doors.at(i));
        builder.painted_look("door_" + std::to_string(i), kDoor_m, 120,
                             [&](vec2 p) { return door_colour(p, paint, night); },
                             {.specular = 0x404040, .shininess = 0.4F});
    }
}

void add_shop_looks(RoomBuilder& builder) {
    builder.painted_look("awning", {1, 1}, 64, [](vec2 p) {
        const vec3 cloth = std::fmod(p.x, 0.5F) < 0.25F ? srgb(0xA6362C) : srgb(0xE9E2D0);
        return cloth * (0.92F + 0.08F * portable::sin(p.x * 4 * portable::kTwoPiF));
    });
    builder.painted_look("shop_inside", {3, 2.3F}, 64, [](vec2 p) {
        const float shelf = std::fmod(p.y + 0.2F, 0.62F);
        const float light = 0.55F + 0.35F * p.y / 2.3F;
        if (shelf < 0.05F) return srgb(0x8A6A48) * light;
        return srgb(0xE8DAC0) * light * (0.65F + 0.35F * smooth_step(0.62F, 0.45F, shelf));
    });
    builder.painted_look("shop_panel", {1, 0.45F}, 120,
                         [](vec2 p) {
                             const float inside = std::min({p.x - 0.08F, 0.92F - p.x, p.y - 0.09F, 0.36F - p.y});
                             const float relief = inside > 0 && inside < 0.02F ? (p.y > 0.22F ? 0.5F : 1.7F) : 1.0F;
                             return srgb(0x23463E) * relief;
                         },
                         {.specular = 0x303030, .shininess = 0.4F});
    builder.look("shop_front", {.diffuse = 0x23463E, .specular = 0x303030, .shininess = 0.4F});
    builder.look("shop_floor", {.diffuse = 0x8A7048});
    builder.look("plinth", {.diffuse = 0xF2EEE4});
    builder.look("shop_glass", {.diffuse = 0xB8C8D0, .specular = 0xA0A0A0, .shininess = 1});
}

}  // namespace

void add_house_looks(World& world, RoomBuilder& builder, float texture_scale, bool night,
                     std::set<std::string>& unlit) {
    for (std::size_t i = 0; i < kWalls.size(); ++i) {
        const auto seed = static_cast<std::uint32_t>(i + 11);
        builder.painted_look("wall_" + std::to_string(i), {kWallTile_m, kWallTile_m}, 128,
                             [&](vec2 p) { return wall_colour(p, kWalls.at(i), seed); });
    }
    builder.painted_look("base_stone", {4, 0.8F}, 128, [](vec2 p) {
        const float dirt = 0.55F + 0.45F * smooth_step(0, 0.5F, p.y);
        return dirt * block_colour(p, {0.8F, 0.4F}, 0.014F, srgb(0xA59C8C), 0.2F, 71);
    });
    builder.painted_look("roof_0", {4, 4}, 100, [](vec2 p) { return roof_colour(p, srgb(0x8E4A36), 81); });
    builder.painted_look("roof_1", {4, 4}, 100, [](vec2 p) { return roof_colour(p, srgb(0x55585E), 82); },
                         {.specular = 0x202020, .shininess = 0.2F});
    add_window_looks(builder, night, unlit);
    add_shop_looks(builder);
    world.textures["railing.png"] = railing_image(texture_scale);
    world.looks["railing"] = {.texture = "railing.png"};
    builder.look("sill", {.diffuse = 0xD9D5CB});
    builder.look("reveal", {.diffuse = 0xB4AFA4});
    builder.look("cornice", {.diffuse = 0xD2CCBE});
    builder.look("chimney", {.diffuse = 0x8A4A3A});
    builder.look("chimney_pot", {.diffuse = 0xA85F42});
    builder.look("roof_flat", {.diffuse = 0x55585A});
    builder.look("step", {.diffuse = 0xA9A59C});
    builder.look("gutter", {.diffuse = 0x4A4F50, .specular = 0x404040, .shininess = 0.3F});
}

}  // namespace rs::synthetic
