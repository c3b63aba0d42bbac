#pragma once
// Ray-space objects in memory, and where a scene puts them.

#include "compositor/scene/scene.hpp"
#include "engine/core/fast/renderer.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <memory>

namespace rs::compositor {

// How much room an object takes, computed from its captured images. Pure; thread-safe.

// An upright cylinder about the object's axis, in object radii.
struct BoundingCylinder {
    double radius = 0;
    double bottom = 0;
    double top = 0;
    [[nodiscard]] bool empty() const { return bottom >= top; }
};

// Holds every point at which the engine can show something of the object: for each image the heights that its
// occupied rows take over all plane points the RS map covers (RECONSTRUCTION.md, section 3, solved for Y). Larger than
// the object itself. Empty where no image shows anything. Looks at every pixel; the images must be loaded.
BoundingCylinder bounding_cylinder(const RaySpaceObject& object);

// An estimate of where the object itself begins and ends on its axis, in object radii: `bottom` is what would touch a
// floor that it stands on, which the object itself may state (RaySpaceObject::foot_q20). Else each image's lowest row
// is taken for the rim of the foot that is nearest to the camera. How far that is before the axis is seen from the
// side, in the images a quarter turn away. Of all images the median counts. The top is found likewise, but with the
// object's width for its depth. Both 0 where no image shows anything.
struct UprightExtent {
    double bottom = 0;
    double top = 0;
};
UprightExtent estimated_extent(const RaySpaceObject& object);

// What is measured on the images is kept beside the renderer, which converts and releases them.
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
