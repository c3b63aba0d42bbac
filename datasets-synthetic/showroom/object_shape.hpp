#pragma once
// How large the procedural objects are as pictures show them, so that they can be placed by their height. In object
// radii: the radius of the upright cylinder around the object (rayspace/base/conventions.hpp).

#include <string>
#include <vector>

namespace rs::synthetic {

struct ObjectShape {
    std::string name;  // of the recipe
    float height_radii = 2.0F;
    float foot_radii = 0.5F;  // radius of what touches the ground, about
};

// One for each of object_names(), with the recipes' parameters.
const std::vector<ObjectShape>& object_shapes();
const ObjectShape& object_shape(const std::string& name);  // the name must be one of them

}  // namespace rs::synthetic
