#pragma once
// Ray-space objects in memory, and where a scene puts them.

#include "compositor/scene/scene.hpp"
#include "compositor/viewer/object_bounds.hpp"
#include "engine/core/renderer.hpp"
#include "rayspace/progress.hpp"
#include "rayspace/result.hpp"

#include <memory>
#include <vector>

namespace rs::compositor {

// What is measured on the pictures is kept beside the renderer, which converts and releases them.
struct ViewableObject {
    engine::Renderer renderer;
    BoundingCylinder bounds;
    UprightExtent extent;
};
// The object has passed validate_object (as read_object's have).
Result<ViewableObject> make_viewable(RaySpaceObject object);

struct PlacedObject {
    std::shared_ptr<const ViewableObject> object;
    Similarity world_from_object;  // object radii to scene units
};
PlacedObject place(std::shared_ptr<const ViewableObject> object, const RaySpaceNode& node);

// Reads the files of the scene's ray-space nodes, each file once, and places them in the order of scene.objects. A node
// whose file cannot be shown is taken out of the scene, with a warning for the file; fails where it is required.
Result<std::vector<PlacedObject>> load_objects(Scene& scene, Progress* progress = nullptr);

}  // namespace rs::compositor
