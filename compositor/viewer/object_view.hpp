#pragma once
// What one ray-space node contributes to one frame, before anything is rendered: which part of the screen, seen by
// which camera in the object's coordinates, at which depth. Pure; thread-safe.
//
// The node's depth is that of its reference plane facing the viewer: the vertical plane through the object's axis whose
// normal points, seen from above, at the viewpoint. But nothing of an object lies below its foot: where a ray meets the
// plane below the height of the foot, the depth is that at which the ray passes through this height (coming down it
// does so before it reaches the plane, going up after it). Otherwise the near rim of a foot would sink into whatever
// the object stands on. Along the screen the reciprocal of a plane's depth is linear, which is what the depth buffer
// holds.

#include "compositor/viewer/placed_object.hpp"
#include "compositor/viewer/screen_rectangle.hpp"

#include <glm/glm.hpp>

#include <optional>

namespace rs::compositor {

struct ObjectView {
    ScreenRectangle rectangle;
    Camera camera;              // of the rectangle alone, in the units of the object's rig: for engine::prepare_view
    double plane_distance = 0;  // from the viewpoint to the facing plane, scene units
    // Reciprocal axial depth, in scene units, at position (x, y) of the whole screen: dot(_, (x, y, 1)) of the facing
    // plane and of the horizontal one through the foot. Seen from above the larger counts, from below the smaller. Not
    // above 0 where the pixel's ray does not meet the plane.
    glm::dvec3 inverse_depth_facing{0.0};
    glm::dvec3 inverse_depth_foot{0.0};
    bool from_above = true;
};

// Nothing where the object is off the screen, smaller than half a pixel, or seen from its own axis.
std::optional<ObjectView> view_of_object(const PlacedObject& placed, const Camera& camera_in_world);

}  // namespace rs::compositor
