#pragma once
// Shell of a room: walls with openings, skirtings and frames around doorways.

#include "datasets-synthetic/showroom/room_builder.hpp"

#include <optional>
#include <string>

namespace rs::synthetic {

// A rectangular opening in a wall, in metres from its lower left corner.
struct Opening {
    glm::vec2 low{0.0F};
    glm::vec2 high{1.0F};
};

// A painted wall; with an opening, up to four pieces around it. `painter` uses positions on the whole wall.
void wall(RoomBuilder& room, const std::string& name, const SheetFrame& place, float px_per_m, const Painter& painter,
          const std::optional<Opening>& opening = {});

// Plaster with darker edges.
Painter plaster_painter(glm::vec2 size_m, glm::vec3 colour, std::uint32_t seed);

// A moulding of four boxes along the walls of a room with depth `depth_m`, interrupted by `gap` (none if
// low_x == high_x).
struct MouldingGap {
    float low_x = 0.0F;
    float high_x = 0.0F;
    bool at_high_z = false;  // in the wall at high.z instead of that at low.z
};
void moulding(RoomBuilder& room, const std::string& look, glm::vec3 low, glm::vec3 high, float depth_m,
              const MouldingGap& gap = {});

}  // namespace rs::synthetic
