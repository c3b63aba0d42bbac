#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/showroom/furniture.hpp"
#include "datasets-synthetic/showroom/surface_painting.hpp"

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

// A metre of wood that goes on where it ends.
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

void furniture_looks(RoomBuilder& room) {
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
    // Glazes, cloths, bindings: chosen by their number.
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
