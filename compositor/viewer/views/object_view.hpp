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
//
// Engines take one captured pixel for each pixel of the image that they render. Where a node is seen from so
// far that captured pixels are smaller than the screen's, a larger image is rendered and averaged, so that a pixel
// of the screen shows all that lies in it. Two across
// bring most of what there is to gain (bench_truth), for up to four times the pixels.

#include "compositor/viewer/residency/placed_object.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"

#include <glm/glm.hpp>

#include <optional>

namespace rs::compositor {

inline constexpr int kMostSamplesAcross = 4;
inline constexpr int kUsualSamplesAcross = 2;  // of screens: more is hardly seen

struct ObjectView {
    ScreenRectangle rectangle;
    // In the units of the object's rig: for engine::prepare_view.
    Camera camera;
    // Position (x, y) of the screen to that of the camera's image: _ * (x, y, 1) = w * (u, v, 1), where w is the
    // axial depth in the image over that on the screen. It may mirror.
    glm::dmat3 image_from_screen{1.0};
    // A pixel of the screen is the mean of so many samples across, each the nearest pixel of the image, or where
    // `smooth` between the nearest four.
    int samples_across = 1;
    bool smooth = false;
    double units_per_rig_unit = 1;  // scene units to the rig's
    double plane_distance = 0;      // from the viewpoint to the facing plane, scene units
    // Reciprocal axial depth, in scene units, at position (x, y) of the whole screen: dot(_, (x, y, 1)) of the facing
    // plane and of the horizontal one through the foot. Seen from above the larger counts, from below the smaller. Not
    // above 0 where the pixel's ray does not meet the plane.
    glm::dvec3 inverse_depth_facing{0.0};
    glm::dvec3 inverse_depth_foot{0.0};
    bool from_above = true;

    // The pixel of the camera's image in the middle of a pixel of the screen, which must lie in the rectangle;
    // nothing where the image does not reach there.
    [[nodiscard]] std::optional<glm::ivec2> image_pixel(int x, int y) const;
};

struct ObjectViewOptions {
    int most_samples_across = kUsualSamplesAcross;  // 1, no averaging, .. kMostSamplesAcross
    bool upright = false;                           // images of upright cameras, where that can be
};

// Nothing where the object is off the screen, smaller than half a pixel, seen from its own axis, or so far aside in a
// very wide image that engines do not draw it (engine::prepare_view).
std::optional<ObjectView> view_of_object(const PlacedObject& placed, const Camera& camera_in_world,
                                         const ObjectViewOptions& options = {});

}  // namespace rs::compositor
