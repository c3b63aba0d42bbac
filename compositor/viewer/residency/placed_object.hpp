#pragma once
// Ray-space objects in memory and their placement in a scene.

#include "compositor/scene/scene.hpp"
#include "engine/core/fast/renderer.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/light/irradiance_harmonics.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace rs::compositor {

// Object bounds, computed from the captured images. Pure; thread-safe.

/// Upright cylinder about the object's axis, in object radii.
struct BoundingCylinder {
    double radius = 0;
    double bottom = 0;
    double top = 0;
    [[nodiscard]] bool empty() const { return bottom >= top; }
};

/// Bound of all points at which the engine can render the object: for each image the heights of its occupied rows over
/// all plane points that the RS map covers (RECONSTRUCTION.md, section 3, solved for Y). Larger than the object itself;
/// empty if all images are. Reads every pixel; images must be loaded.
BoundingCylinder bounding_cylinder(const RaySpaceObject& object);

/// Estimated vertical extent of the object itself on its axis, in object radii. `bottom` is the height of the floor
/// contact: RaySpaceObject::foot_q20 if given; otherwise each image's lowest row is taken as the near rim of the foot,
/// whose distance from the axis is measured in the images a quarter turn away. The median over the images is used.
/// `top` is found in the same way from the object's width. Both are 0 if all images are empty.
struct UprightExtent {
    double bottom = 0;
    double top = 0;
};
UprightExtent estimated_extent(const RaySpaceObject& object);

/// Renderer and measurements. Measurements are taken first, since the renderer converts and releases the images.
struct ViewableObject {
    engine::Renderer renderer;
    BoundingCylinder bounds;
    UprightExtent extent;
    std::shared_ptr<const RaySpaceObject> for_board = nullptr;  // see engine::PreparedObject
    std::string not_on_board = {};                              // likewise
    std::optional<IrradianceHarmonics> capture_irradiance{};    // kCaptureIrradianceKey, if known

    [[nodiscard]] std::int64_t memory_bytes() const;
};
/// \param object must have passed validate_object (as the results of read_object have).
Result<ViewableObject> make_viewable(RaySpaceObject object);

struct PlacedObject {
    std::shared_ptr<const ViewableObject> object;
    Similarity world_from_object;  // object radii to scene units
};
PlacedObject place(std::shared_ptr<const ViewableObject> object, const RaySpaceNode& node);

}  // namespace rs::compositor
