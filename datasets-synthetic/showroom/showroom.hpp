#pragma once
// The showroom: a shop and a museum room with the procedural objects on shelves, tables and plinths, and a way through
// both.

#include "datasets-synthetic/showroom/world.hpp"

namespace rs::synthetic {

struct ShowroomOptions {
    float texture_scale = 1.0F;  // (0, 1]: of the textures' resolutions
};

// The same world every time. Some 10,000 triangles. Thread-safe. Takes some seconds at full texture size.
World make_showroom(const ShowroomOptions& options = {});

}  // namespace rs::synthetic
