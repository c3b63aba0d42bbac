#pragma once
// Valid objects of the golden files: raw, encoded, and random streams, which cover more of the format than the
// encoders.

#include "rayspace/object/ray_space_object.hpp"

#include <string>
#include <vector>

namespace rs::golden {

struct GoldenObject {
    std::string name;  // file name without extension
    RaySpaceObject object;
    bool has_plain_lines = false;
};

std::vector<GoldenObject> golden_objects();

}  // namespace rs::golden
