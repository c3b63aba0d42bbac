#pragma once
// Walls with openings, skirtings and frames around doorways: what every room begins with.

#include "datasets-synthetic/showroom/room_builder.hpp"

#include <optional>
#include <string>

namespace rs::synthetic {

// A rectangle left out of a wall, in metres from its lower left corner.
struct Opening {
    glm::vec2 low{0.0F};
    glm::vec2 high{1.0F};
};

// A painted wall; where it has an opening it is made of the up to four pieces around it. `painter` takes places on the
// whole wall.
void wall(RoomBuilder& room, const std::string& name, const SheetPlace& place, float px_per_m, const Painter& painter,
          const std::optional<Opening>& opening = {});

// Plaster that is darker where it meets other surfaces.
Painter plastered(glm::vec2 size_m, glm::vec3 colour, std::uint32_t seed);

// A moulding of four boxes along the walls of a room, standing out by `depth_m`; `gap` is left free in the wall at
// z = `gap_z` (no gap where gap_low == gap_high).
struct MouldingGap {
    float low_x = 0.0F;
    float high_x = 0.0F;
    bool at_high_z = false;  // in the wall at high.z instead of that at low.z
};
void moulding(RoomBuilder& room, const std::string& look, glm::vec3 low, glm::vec3 high, float depth_m,
              const MouldingGap& gap = {});

}  // namespace rs::synthetic
