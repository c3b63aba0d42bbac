#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/showroom/furniture.hpp"
#include "datasets-synthetic/showroom/painting.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

constexpr float kBoard_m = 0.03F;
constexpr float kUpright_m = 0.035F;
constexpr float kFace_m = 0.012F;  // setback of the boards from the uprights' faces

std::string capitals(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

void carcass(RoomBuilder& room, const ShelfUnit& unit) {
    const float depth = unit.depth_m;
    // Its back, darker in the angles with the boards.
    const float height = unit.top_m - 0.08F;
    const float pitch = (unit.length_m - kUpright_m) / static_cast<float>(unit.bays);
    room.painted_sheet(
        unit.name + "_back", {{0, 0.08F, 0.015F}, {unit.length_m, 0, 0}, {0, height, 0}}, 90, [&](vec2 p) {
            float light = corner_shadow(height - p.y, 0.14F, 0.5F);
            for (const float board : unit.heights_m) {
                const float above = p.y + 0.08F - board;
                light *= above > 0 ? corner_shadow(above, 0.09F, 0.35F) : corner_shadow(-above - kBoard_m, 0.14F, 0.5F);
            }
            const float in_bay = p.x - kUpright_m - pitch * std::floor((p.x - kUpright_m) / pitch);
            const float sides = corner_shadow(std::min(in_bay, pitch - kUpright_m - in_bay), 0.1F, 0.35F);
            return plaster(p, srgb(0x7F9385), unit.seed) * light * sides;
        });
    for (int k = 0; k <= unit.bays; ++k) {
        const float x = (unit.length_m - kUpright_m) * static_cast<float>(k) / static_cast<float>(unit.bays);
        room.box("walnut", {x, 0.08F, 0.015F}, {x + kUpright_m, unit.top_m, depth});
    }
    room.box("walnut", {0.02F, 0, 0.03F}, {unit.length_m - 0.02F, 0.08F, depth - 0.05F});
    room.soft_box("green_paint", {-0.05F, unit.top_m, 0.0F}, {unit.length_m + 0.05F, unit.top_m + 0.09F, depth + 0.06F},
                  0.02F);
}

// Cupboard doors with panels and knobs below the first board.
void cupboards(RoomBuilder& room, const ShelfUnit& unit) {
    const float pitch = (unit.length_m - kUpright_m) / static_cast<float>(unit.bays);
    const float top = unit.heights_m.front() - kBoard_m - 0.018F;
    for (int bay = 0; bay < unit.bays; ++bay) {
        const float left = pitch * static_cast<float>(bay) + kUpright_m;
        const float middle = left + 0.5F * (pitch - kUpright_m);
        for (const float side : {-1.0F, 1.0F}) {
            const float from = side < 0 ? left + 0.003F : middle + 0.002F;
            const float to = side < 0 ? middle - 0.002F : left + pitch - kUpright_m - 0.003F;
            const float front = unit.depth_m - 0.006F;
            room.box("green_paint", {from, 0.085F, front - 0.02F}, {to, top, front});
            const vec2 profile[] = {{0.0F, 0.0F}, {0.01F, 0.009F}, {0.03F, 0.0F}};
            room.image_frame("green_paint",
                             {{from + 0.06F, 0.15F, front}, {to - from - 0.12F, 0, 0}, {0, top - 0.15F - 0.06F, 0}},
                             profile);
            const float knob = middle + side * 0.04F;
            room.box("brass", {knob - 0.01F, 0.34F, front}, {knob + 0.01F, 0.46F, front + 0.018F});
        }
    }
}

void boards(RoomBuilder& room, const ShelfUnit& unit) {
    const WoodTone oak{srgb(0xD0A06A), srgb(0x966A3E)};
    const float pitch = (unit.length_m - kUpright_m) / static_cast<float>(unit.bays);
    for (std::size_t board = 0; board < unit.heights_m.size(); ++board) {
        std::vector<Footprint> prints;
        for (const ShelfObject& place : unit.objects) {
            if (place.board != static_cast<int>(board)) continue;
            const float half = foot_radius(place.name, place.height_m);
            const float z = 0.5F * unit.depth_m;
            prints.push_back({{place.x_m - half, z - half}, {place.x_m + half, z + half}, 0.05F, 0.55F, true});
        }
        const float y = unit.heights_m[board];
        for (int bay = 0; bay < unit.bays; ++bay) {
            const float left = pitch * static_cast<float>(bay) + kUpright_m;
            const float width = pitch - kUpright_m;
            const float front = unit.depth_m - kFace_m;
            const Painter top = [&](vec2 p) {
                const vec2 place{left + p.x, front - p.y};
                const float back = corner_shadow(place.y, 0.16F, 0.5F);
                const float sides = corner_shadow(std::min(p.x, width - p.x), 0.07F, 0.4F);
                const WoodTone tone = oak;
                return wood(place, tone, unit.seed + static_cast<std::uint32_t>(board)) * back * sides *
                       contact_shadow(place, prints);
            };
            const std::string name = unit.name + "_board" + std::to_string(board) + static_cast<char>('a' + bay);
            room.box_with_top("oak", name, {left, y - kBoard_m, 0.015F}, {left + width, y, front}, 220, top);
            // The rail for prices.
            room.box("brass", {left, y - kBoard_m - 0.012F, front}, {left + width, y - 0.002F, front + 0.006F});
        }
    }
}

}  // namespace

void name_card(RoomBuilder& room, const std::string& texture, const std::string& text, vec3 lower_middle, vec2 size_m) {
    const auto ink = lettering(capitals(text), size_m, 0.45F * size_m.y, 0.06F * size_m.y);
    room.painted_sheet(texture, {lower_middle - vec3{0.5F * size_m.x, 0, 0}, {size_m.x, 0, 0}, {0, size_m.y, 0}}, 900,
                       [&](vec2 p) { return srgb(0xF4EDDD) * (1.0F - 0.85F * ink(p)); });
}

void shelf_unit(RoomBuilder& room, const ShelfUnit& unit) {
    carcass(room, unit);
    cupboards(room, unit);
    boards(room, unit);
    int card = 0;
    for (const ShelfObject& place : unit.objects) {
        const float y = unit.heights_m[static_cast<std::size_t>(place.board)];
        room.object(place.name, {place.x_m, y, 0.5F * unit.depth_m}, place.turn_deg, place.height_m);
        name_card(room, unit.name + "_card" + std::to_string(card++), place.name,
                  {place.x_m, y - 0.045F, unit.depth_m - kFace_m + 0.009F}, {0.12F, 0.045F});
    }
}

}  // namespace rs::synthetic
