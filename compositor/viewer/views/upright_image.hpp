#pragma once
// The same rays by a level camera. What a camera sees depends on where it is alone; which way it looks only decides
// where on its image a ray meets it. So an image that an upright camera takes in the same place holds all that a
// tilted one sees, and a homography gives where. Engines are several times faster at images of upright cameras, a
// column of which is one vertical plane of rays, and boards draw no others. Pure; thread-safe.

#include "compositor/viewer/residency/placed_object.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"
#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

#include <optional>

namespace rs::compositor {

struct UprightImage {
    Camera camera;  // upright (is_upright), right-handed, of the part that is needed
    // Position (x, y) of the given camera's image to that of the upright one: image_from_screen * (x, y, 1) =
    // w * (u, v, 1), where w is the axial depth along the upright camera's forward over that along the given one's.
    glm::dmat3 image_from_screen{1.0};
};

// For what lies in `bounds` and is seen in `area`, which is a part of the camera's image; the camera is in the
// bound's coordinates and may be left-handed. A pixel of the area has at least samples_across > 0 pixels across in
// every direction, at its middle. Nothing where the view is so steep that the upright image would be stretched
// to more than about three times the pixels, or where none of the bound is in the area.
std::optional<UprightImage> upright_image(const Camera& camera, const ScreenRectangle& area,
                                          const BoundingCylinder& bounds, double samples_across);

}  // namespace rs::compositor
