#pragma once
// Ray-space objects in memory, and where a scene puts them.

#include "compositor/scene/scene.hpp"
#include "compositor/viewer/residency/object_bounds.hpp"
#include "engine/core/fast/renderer.hpp"
#include "rayspace/base/result.hpp"

#include <cstdint>
#include <memory>

namespace rs::compositor {

// What is measured on the pictures is kept beside the renderer, which converts and releases them.
struct ViewableObject {
    engine::Renderer renderer;
    BoundingCylinder bounds;
    UprightExtent extent;
    std::shared_ptr<const RaySpaceObject> for_board = nullptr;  // as engine::PreparedObject

    [[nodiscard]] std::int64_t memory_bytes() const;
};
// The object has passed validate_object (as read_object's have).
Result<ViewableObject> make_viewable(RaySpaceObject object);

struct PlacedObject {
    std::shared_ptr<const ViewableObject> object;
    Similarity world_from_object;  // object radii to scene units
};
PlacedObject place(std::shared_ptr<const ViewableObject> object, const RaySpaceNode& node);

}  // namespace rs::compositor
