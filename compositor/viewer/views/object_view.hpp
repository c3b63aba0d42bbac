#pragma once
// Geometry of one ray-space node in one frame, before rendering: screen rectangle, camera in object coordinates, depth.
// Pure; thread-safe.
//
// The node's depth is that of its facing reference plane: the vertical plane through the object's axis whose normal
// points to the viewpoint as seen from above. Objects do not extend below their foot: where a ray meets the plane below
// the foot's height, the depth is that at which the ray crosses this height (before the plane if it descends, behind it
// if it ascends). Otherwise the near rim of a foot would sink into the floor. The reciprocal depth of a plane is linear
// in screen coordinates, and is what the depth buffer stores.
//
// Captures have no views from straight above or below. Steeper than 60 degrees, and than the highest ring, an object is
// rendered as from this elevation, turned about its middle: it stays visible, like its shadow, but seems to lean.
//
// Engines take one captured pixel per rendered pixel. If captured pixels are smaller than screen pixels, a larger image
// is rendered and averaged, which avoids aliasing. Two samples across give most of the gain (bench_truth) for up to
// four times the pixels.

#include "compositor/viewer/residency/placed_object.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"

#include <glm/glm.hpp>

#include <optional>

namespace rs::compositor {

inline constexpr int kMaxSamplesAcross = 4;
inline constexpr int kDefaultSamplesAcross = 2;  // for screens; more samples are hardly visible

struct ObjectView {
    ScreenRectangle rectangle;
    /// In the units of the object's rig, for engine::prepare_view.
    Camera camera;
    /// Maps screen position (x, y) to the camera's image: image_from_screen * (x, y, 1) = w * (u, v, 1), where w is the
    /// axial depth in the image over that on the screen. May mirror.
    glm::dmat3 image_from_screen{1.0};
    /// A screen pixel is the mean of samples_across^2 samples, each the nearest image pixel, or bilinear if `smooth`.
    int samples_across = 1;
    bool smooth = false;
    double units_per_rig_unit = 1;  // scene units per rig unit
    double plane_distance = 0;      // from the viewpoint to the facing plane, scene units
    /// Reciprocal axial depth (1 / scene units) at position (x, y) of the whole screen, dot(_, (x, y, 1)), of the
    /// facing plane and of the horizontal plane through the foot. The larger one counts from above, the smaller from
    /// below. Not positive if the pixel's ray misses the plane.
    glm::dvec3 inverse_depth_facing{0.0};
    glm::dvec3 inverse_depth_foot{0.0};
    bool from_above = true;

    /// Image pixel at the centre of a screen pixel of the rectangle; nullopt if outside of the image.
    [[nodiscard]] std::optional<glm::ivec2> image_pixel(int x, int y) const;
};

struct ObjectViewOptions {
    int max_samples_across = kDefaultSamplesAcross;  // 1 (no averaging) .. kMaxSamplesAcross
    bool upright = false;                            // renders images of upright cameras where possible
};

/// \return nullopt if the object is off screen, smaller than half a pixel, viewed from its own middle, or so far off
/// axis in a very wide image that engines cannot render it (engine::prepare_view).
std::optional<ObjectView> view_of_object(const PlacedObject& placed, const Camera& camera_in_world,
                                         const ObjectViewOptions& options = {});

}  // namespace rs::compositor
