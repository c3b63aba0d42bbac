#include "datasets-synthetic/showroom/furniture.hpp"

#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/showroom/painting.hpp"

#include <vector>

namespace rs::synthetic {

using glm::vec2;
using glm::vec3;

void pendant(RoomBuilder& room, vec3 ceiling, float height_m) {
    const float cord_end = height_m + 0.32F;
    room.lathe("iron", {ceiling.x, ceiling.y - 0.03F, ceiling.z},
               {{0.0F, 0.0F}, {0.05F, 0.0F}, {0.06F, 0.03F}, {0.0F, 0.03F}}, 10);
    room.lathe(
        "iron", {ceiling.x, cord_end, ceiling.z},
        {{0.0F, 0.0F}, {0.006F, 0.0F}, {0.006F, ceiling.y - 0.03F - cord_end}, {0.0F, ceiling.y - 0.03F - cord_end}},
        6);
    const vec3 foot{ceiling.x, height_m, ceiling.z};
    room.lathe("brass", foot, {{0.0F, 0.26F}, {0.035F, 0.26F}, {0.035F, 0.3F}, {0.0F, 0.33F}}, 10);
    // The shade is one solid: its profile runs down the inside and up the outside.
    room.lathe("shade_green", foot,
               {{0.0F, 0.25F},
                {0.064F, 0.212F},
                {0.144F, 0.114F},
                {0.196F, 0.0F},
                {0.20F, 0.0F},
                {0.15F, 0.12F},
                {0.07F, 0.22F},
                {0.036F, 0.262F},
                {0.0F, 0.264F}},
               16, 0.9F);
    room.lathe("bulb", foot, {{0.0F, 0.03F}, {0.04F, 0.045F}, {0.05F, 0.09F}, {0.02F, 0.16F}, {0.0F, 0.2F}}, 10, 1.2F);
}

void plinth(RoomBuilder& room, const std::string& name, const std::string& object, float width_m, float height_m,
            float object_height_m) {
    const float half = 0.5F * width_m;
    const float foot = half + 0.03F;
    const float cap = half + 0.015F;
    room.box("white_paint", {-foot, 0, -foot}, {foot, 0.09F, foot});
    const float shaft_top = height_m - 0.035F;
    room.painted_look(name + "_side", {width_m, shaft_top - 0.09F}, 60, [&](vec2 p) {
        const float floor = corner_shadow(p.y, 0.12F, 0.35F);
        const float top = corner_shadow(shaft_top - 0.09F - p.y, 0.03F, 0.3F);
        return srgb(0xDFDDD6) * floor * top;
    });
    const float low = 0.09F;
    const float up = shaft_top - low;
    room.sheet(name + "_side", {{-half, low, half}, {width_m, 0, 0}, {0, up, 0}});
    room.sheet(name + "_side", {{half, low, half}, {0, 0, -width_m}, {0, up, 0}});
    room.sheet(name + "_side", {{half, low, -half}, {-width_m, 0, 0}, {0, up, 0}});
    room.sheet(name + "_side", {{-half, low, -half}, {0, 0, width_m}, {0, up, 0}});
    const float print = foot_radius(object, object_height_m);
    const Footprint shadow{vec2{cap - print}, vec2{cap + print}, 0.07F, 0.5F, true};
    room.box_with_top("white_paint", name, {-cap, shaft_top, -cap}, {cap, height_m, cap}, 160,
                      [&](vec2 p) { return srgb(0xE4E2DC) * contact_shadow(p, std::span(&shadow, 1)); });
    room.object(object, {0, height_m, 0}, 0, object_height_m);
    name_card(room, name + "_label", object, {0, height_m - 0.28F, half + 0.004F}, {0.24F, 0.08F});
}

void rope_barrier(RoomBuilder& room, std::span<const vec3> posts, bool closed) {
    constexpr float kHook_m = 0.86F;
    for (const vec3& foot : posts) {
        room.lathe("brass", foot,
                   {{0.0F, 0.0F},
                    {0.15F, 0.0F},
                    {0.15F, 0.015F},
                    {0.03F, 0.05F},
                    {0.02F, 0.84F},
                    {0.032F, 0.88F},
                    {0.03F, 0.95F},
                    {0.0F, 0.975F}},
                   12, 0.7F);
    }
    const std::size_t ropes = closed ? posts.size() : posts.size() - 1;
    for (std::size_t k = 0; k < ropes; ++k) {
        const vec3 from = posts[k] + vec3{0, kHook_m, 0};
        const vec3 to = posts[(k + 1) % posts.size()] + vec3{0, kHook_m, 0};
        std::vector<vec3> path;
        constexpr int kSteps = 8;
        for (int step = 0; step <= kSteps; ++step) {
            const float t = static_cast<float>(step) / kSteps;
            const float sag = 0.24F * 4.0F * t * (1.0F - t);
            path.push_back(from + (to - from) * t - vec3{0, sag, 0});
        }
        room.tube("rope", path, 0.018F, 5);
    }
}

void bench(RoomBuilder& room, float length_m) {
    const float half = 0.5F * length_m;
    room.soft_box("leather", {-half, 0.38F, -0.24F}, {half, 0.47F, 0.24F}, 0.03F);
    room.box("walnut", {-half + 0.03F, 0.32F, -0.21F}, {half - 0.03F, 0.38F, 0.21F});
    for (const float x : {-half + 0.12F, half - 0.18F}) {
        for (const float z : {-0.19F, 0.13F}) room.box("walnut", {x, 0, z}, {x + 0.06F, 0.32F, z + 0.06F});
    }
}

void framed_painting(RoomBuilder& room, const std::string& name, vec3 middle, vec2 size_m, const Painter& painter) {
    constexpr float kFrame_m = 0.09F;
    const vec3 corner = middle - vec3{0.5F * size_m.x, 0.5F * size_m.y, 0};
    room.painted_sheet(name, {corner + vec3{0, 0, 0.015F}, {size_m.x, 0, 0}, {0, size_m.y, 0}}, 300, painter);
    const vec2 profile[] = {
        {0.0F, 0.0F}, {0.0F, 0.035F}, {0.02F, 0.045F}, {0.06F, 0.028F}, {kFrame_m + 0.004F, 0.014F}};
    room.image_frame(
        "gilt",
        {corner - vec3{kFrame_m, kFrame_m, 0}, {size_m.x + 2 * kFrame_m, 0, 0}, {0, size_m.y + 2 * kFrame_m, 0}},
        profile);
}

namespace {

using glm::vec2;
using glm::vec3;

// One metre of seamlessly tiling wood.
Painter endless_wood(const WoodTone& tone, std::uint32_t seed) {
    return [=](vec2 p) {
        constexpr float kFade = 0.7F;
        const vec3 here = wood(p, tone, seed);
        if (p.x < kFade) return here;
        const float share = (p.x - kFade) / (1.0F - kFade);
        return here + (wood(p - vec2{1.0F, 0.0F}, tone, seed) - here) * share;
    };
}

}  // namespace

void add_furniture_looks(RoomBuilder& room) {
    const WoodTone walnut{srgb(0x8A5A38), srgb(0x4E2F1D)};
    const WoodTone oak{srgb(0xC89A66), srgb(0x8E6238)};
    room.painted_look("walnut", {1, 1}, 320, endless_wood(walnut, 21), {.specular = 0x302820, .shininess = 0.25F});
    room.painted_look("oak", {1, 1}, 320, endless_wood(oak, 22), {.specular = 0x282420, .shininess = 0.25F});
    const WoodTone cane{srgb(0xD0A467), srgb(0x5A3A1C)};
    room.painted_look("cane", {1.2F, 0.6F}, 220, [=](vec2 p) { return wicker(p, 0.03F, cane, 23); });

    room.look("brass", {.diffuse = 0xA8813C, .specular = 0xE8CF96, .shininess = 0.45F});
    room.look("iron", {.diffuse = 0x2B2A29, .specular = 0x4A4846, .shininess = 0.3F});
    room.look("card", {.diffuse = 0xF4EDDD});
    room.look("bulb", {.diffuse = 0xFFE9C4, .emissive = 0xFFE6B8});
    room.look("rope", {.diffuse = 0x7A1F24, .specular = 0x301010, .shininess = 0.1F});
    room.look("leather", {.diffuse = 0x6B3D26, .specular = 0x3A2C24, .shininess = 0.3F});
    room.look("gilt", {.diffuse = 0xA98443, .specular = 0xC9A968, .shininess = 0.3F});
    room.look("white_paint", {.diffuse = 0xDDDBD4, .specular = 0x141414});
    room.look("shade_green", {.diffuse = 0x2C4A40, .specular = 0x5A6A62, .shininess = 0.5F});
    room.look("green_paint", {.diffuse = 0x3B5A4C, .specular = 0x1A1E1C, .shininess = 0.3F});
    // Glazes, cloths, bindings, selected by index.
    constexpr std::uint32_t kGlazes[] = {0xE9E2D0, 0x9DB8A6, 0x2F5573, 0xB5653A, 0x3E3A36, 0xD9B25F};
    constexpr std::uint32_t kCloths[] = {0xE6DCC8, 0xA94F3B, 0x53707E, 0xC9A15A, 0x6F7F5D, 0x8B5A6B};
    constexpr std::uint32_t kBindings[] = {0x6B2C2A, 0x2E4A42, 0x27384F, 0xB08B57, 0x4A3A4F, 0xC9BFA9};
    for (std::size_t k = 0; k < 6; ++k) {
        const std::string number = std::to_string(k);
        room.look("glaze" + number, {.diffuse = kGlazes[k], .specular = 0x8C8C8C, .shininess = 0.55F});
        room.look("cloth" + number, {.diffuse = kCloths[k]});
        room.look("binding" + number, {.diffuse = kBindings[k], .specular = 0x1C1C1C, .shininess = 0.15F});
    }
}

}  // namespace rs::synthetic
