#pragma once
// The part of the screen that a bounding cylinder can cover. Pure; thread-safe.

#include "compositor/viewer/residency/object_bounds.hpp"
#include "rayspace/geometry/camera.hpp"

#include <optional>

namespace rs::compositor {

// Pixels [x, x + width) x [y, y + height).
struct ScreenRectangle {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    bool operator==(const ScreenRectangle&) const = default;
};

// Every pixel whose rays may meet the cylinder, cut to the camera's picture; nothing where the cylinder is empty,
// behind the camera or off the screen. The camera is in the cylinder's coordinates and may stand inside of it.
std::optional<ScreenRectangle> covering_rectangle(const BoundingCylinder& bound, const Camera& camera);

}  // namespace rs::compositor
