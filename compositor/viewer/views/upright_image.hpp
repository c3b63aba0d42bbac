#pragma once
// Replaces a tilted camera by an upright one. The rays of a camera depend on its centre alone; its rotation only
// determines where they meet the image. So the image of an upright camera with the same centre contains the tilted
// image, related by a homography. Engines render upright images several times faster, since an image column is one
// vertical plane of rays; boards support no others. Pure; thread-safe.

#include "compositor/viewer/residency/placed_object.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"
#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

#include <optional>

namespace rs::compositor {

struct UprightImage {
    Camera camera;  // upright (is_upright), right-handed, cropped to the required part
    /// Maps position (x, y) of the given camera's image: image_from_screen * (x, y, 1) = w * (u, v, 1), where w is the
    /// axial depth along the upright camera's forward over that along the given one's.
    glm::dmat3 image_from_screen{1.0};
};

/// Upright image of the part of `bounds` that is visible in `area` of the camera's image.
/// \param camera in the coordinates of `bounds`; may be left-handed.
/// \param samples_across > 0; minimum number of image pixels per screen pixel in every direction, at the centre of the
/// area.
/// \return nullopt if the view is so steep that the upright image would need more than about three times the pixels, or
/// if the area does not contain the bounds.
std::optional<UprightImage> upright_image(const Camera& camera, const ScreenRectangle& area,
                                          const BoundingCylinder& bounds, double samples_across);

}  // namespace rs::compositor
