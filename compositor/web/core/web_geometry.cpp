// C interface of the WebAssembly module: camera, ground and surface of the opened object, for what a page places in its
// views. Angles in radians, lengths in object radii.

#include "compositor/web/core/web_core.hpp"
#include "compositor/web/view/footprint.hpp"
#include "compositor/web/view/surface_point.hpp"

using namespace rs::web;

/// Half width and half height of the captured photos at depth 1, with which the pinhole camera of an orbit is computed
/// (ObjectView::camera_of).
WEB_EXPORT const double* web_lens() {
    static double values[2];
    const CapturedCamera& captured = opened_view()->captured().front();
    values[0] = captured.tan_half_x;
    values[1] = captured.tan_half_y;
    return values;
}

/// Footprint of the object (footprint.hpp): 64 x 64 bytes, in rows along +X. Y of the ground is written to `ground`.
WEB_EXPORT const std::uint8_t* web_footprint(double* ground) {
    static Footprint made;
    made = footprint(opened_view()->object());
    *ground = made.ground;
    return made.clearance.data();
}

/// Surface at pixel position (x, y) of a view (surface_point.hpp): position and normal, 6 numbers, or null.
WEB_EXPORT const double* web_surface_point(const double* view, double x, double y) {
    static double values[6];
    const OrbitView orbit{static_cast<int>(view[0]), static_cast<int>(view[1]), view[2], view[3], view[4]};
    const std::optional<SurfacePoint> found = surface_point(*opened_view(), orbit, x, y);
    if (!found) return nullptr;
    for (int axis = 0; axis < 3; ++axis) {
        values[axis] = found->position[axis];
        values[3 + axis] = found->normal[axis];
    }
    return values;
}

/// Pixel position and depth of the point (x, y, z) in a view, 3 numbers.
WEB_EXPORT const double* web_project(const double* view, double x, double y, double z) {
    static double values[3];
    const OrbitView orbit{static_cast<int>(view[0]), static_cast<int>(view[1]), view[2], view[3], view[4]};
    const glm::dvec3 at = opened_view()->camera_of(orbit).project({x, y, z});
    for (int axis = 0; axis < 3; ++axis) values[axis] = at[axis];
    return values;
}
