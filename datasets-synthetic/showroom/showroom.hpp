#pragma once
// The showroom: a shop and a museum room with the procedural objects on shelves, tables and plinths, and a camera path
// through both.

#include "datasets-synthetic/showroom/world.hpp"

namespace rs::synthetic {

struct ShowroomOptions {
    float texture_scale = 1.0F;  // (0, 1]: factor on the textures' resolutions
};

// Deterministic. About 10,000 triangles. Thread-safe. Takes a few seconds at full texture size.
World make_showroom(const ShowroomOptions& options = {});

}  // namespace rs::synthetic
