#pragma once
// Point of an object's surface that a pixel of a view shows, for hotspots.

#include "compositor/web/view/object_view.hpp"

#include <glm/glm.hpp>

#include <optional>

namespace rs::web {

/// Lengths in object radii, object frame.
struct SurfacePoint {
    glm::dvec3 position{0};
    glm::dvec3 normal{0};  // unit length, towards the viewer; coarse, from depths some pixels apart
};

/// Surface at position (x, y) of a view's image, in pixels (conventions.hpp). \return nullopt beside the object, or if
/// the camera is out of range. Cost: a view of a few pixels.
std::optional<SurfacePoint> surface_point(const ObjectView& object, const OrbitView& view, double x, double y);

}  // namespace rs::web
