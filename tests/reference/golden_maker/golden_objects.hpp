#pragma once
// The valid objects of the golden files: raw, of the encoders, and of random streams, which reach more of the format
// than an encoder does.

#include "rayspace/object/ray_space_object.hpp"

#include <string>
#include <vector>

namespace rs::golden {

struct GoldenObject {
    std::string name;  // of the file, without its extension
    RaySpaceObject object;
    bool has_plain_lines = false;
};

std::vector<GoldenObject> golden_objects();

}  // namespace rs::golden
