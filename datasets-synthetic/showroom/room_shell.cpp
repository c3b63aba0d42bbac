#include "datasets-synthetic/showroom/room_shell.hpp"

#include "datasets-synthetic/showroom/painting.hpp"

#include <algorithm>

namespace rs::synthetic {

using glm::vec2;
using glm::vec3;

void wall(RoomBuilder& room, const std::string& name, const SheetFrame& place, float px_per_m, const Painter& painter,
          const std::optional<Opening>& opening) {
    const vec3 right = glm::normalize(place.right);
    const vec3 up = glm::normalize(place.up);
    const vec2 size{glm::length(place.right), glm::length(place.up)};
    const auto piece = [&](const std::string& suffix, vec2 low, vec2 high) {
        if (!(low.x < high.x && low.y < high.y)) return;
        room.painted_sheet(name + suffix,
                           {place.corner + right * low.x + up * low.y, right * (high.x - low.x), up * (high.y - low.y)},
                           px_per_m, [&painter, low](vec2 p) { return painter(p + low); });
    };
    if (!opening) return piece("", vec2{0.0F}, size);
    piece("_left", vec2{0.0F}, {opening->low.x, size.y});
    piece("_right", {opening->high.x, 0.0F}, size);
    piece("_above", {opening->low.x, opening->high.y}, {opening->high.x, size.y});
    piece("_below", {opening->low.x, 0.0F}, {opening->high.x, opening->low.y});
}

Painter plaster_painter(vec2 size_m, vec3 colour, std::uint32_t seed) {
    return [=](vec2 p) {
        const float sides = corner_shadow(std::min(p.x, size_m.x - p.x), 0.35F, 0.22F);
        const float floor = corner_shadow(p.y, 0.3F, 0.22F);
        const float ceiling = corner_shadow(size_m.y - p.y, 0.35F, 0.22F);
        return plaster(p, colour, seed) * sides * floor * ceiling;
    };
}

void moulding(RoomBuilder& room, const std::string& look, vec3 low, vec3 high, float depth_m, const MouldingGap& gap) {
    const float d = depth_m;
    room.box(look, low, {low.x + d, high.y, high.z});
    room.box(look, {high.x - d, low.y, low.z}, high);
    for (const bool far_side : {false, true}) {
        const float z = far_side ? high.z - d : low.z;
        const auto along = [&](float from, float to) {
            if (from < to) room.box(look, {from, low.y, z}, {to, high.y, z + d});
        };
        if (gap.low_x < gap.high_x && gap.at_high_z == far_side) {
            along(low.x + d, gap.low_x);
            along(gap.high_x, high.x - d);
        } else {
            along(low.x + d, high.x - d);
        }
    }
}

}  // namespace rs::synthetic
