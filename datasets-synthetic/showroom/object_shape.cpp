#include "datasets-synthetic/showroom/object_shape.hpp"

#include "rayspace/base/check.hpp"

#include <algorithm>

namespace rs::synthetic {

const std::vector<ObjectShape>& object_shapes() {
    static const std::vector<ObjectShape> kShapes = {{"vase", 3.375F, 0.6F},     {"flower", 2.611F, 0.36F},
                                                     {"doll", 1.969F, 0.75F},    {"lamp", 5.212F, 0.85F},
                                                     {"lattice", 1.938F, 0.55F}, {"blocks", 2.07F, 0.8F}};
    return kShapes;
}

const ObjectShape& object_shape(const std::string& name) {
    const std::vector<ObjectShape>& shapes = object_shapes();
    const auto found =
        std::find_if(shapes.begin(), shapes.end(), [&](const auto& shape) { return shape.name == name; });
    RS_CHECK(found != shapes.end());
    return *found;
}

}  // namespace rs::synthetic
