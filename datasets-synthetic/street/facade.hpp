#pragma once
// Parts of facades: walls with recessed windows, doors, ledges. All face +Z in the pen's frame, the wall's surface at
// z = 0.

#include "datasets-synthetic/street/pen.hpp"

#include <glm/glm.hpp>

#include <span>
#include <string>

namespace rs::synthetic {

// A hole in a wall, closed by a painted sheet behind it.
struct FacadeOpening {
    float left = 0;
    float width = 1;
    std::string look;       // of the sheet
    bool surround = false;  // a moulding around it
    bool balcony = false;
};

struct WallBand {
    std::string wall;  // look
    float left = 0;
    float right = 1;
    float low = 0;
    float high = 1;
    float sill = 0;  // of the openings, y
    float head = 1;
};

// Wall from `low` to `high` with openings from `sill` to `head`, in order from left to right.
void wall_with_openings(Pen& pen, const WallBand& band, std::span<const FacadeOpening> openings);

// Mouldings of three steps along X, their upper edge at `top`.
void cornice(Pen& pen, float left, float right, float top, float depth_m);

// Awning with a valance and closed sides, `head` at the wall.
void awning(Pen& pen, float left, float right, float head);

}  // namespace rs::synthetic
