#pragma once
// Ray geometry in floating point: reference planes, a viewpoint as a line of ray space, and the rectification of
// pitched cameras. Used offline; engine/RECONSTRUCTION.md defines the renderer's integer form.
//
// Source: Sakagawa, Katayama, Kotake, Tamura, "A Hardware Ray-Space Data Renderer for Interactive Augmented
// Virtuality", section 2, equation 1. All functions are thread-safe.

#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

namespace rs {

/// Reference plane k of `count`. It contains the Y axis; plane k + count/2 is the same plane seen from behind,
/// mirrored.
struct ReferencePlane {
    glm::dvec3 normal;   // n_k = (sin t, 0, cos t), t = 2 pi k / count
    glm::dvec3 tangent;  // t_k = (cos t, 0, -sin t)
};
ReferencePlane reference_plane(int k, int count);

/// A viewpoint in the frame of a plane: a along the tangent, b in height, c along the normal. Its rays are the line x =
/// a + u c of the (x, u) plane (equation 1).
struct ViewpointLine {
    double a = 0;
    double b = 0;
    double c = 0;
    [[nodiscard]] double u_at(double x) const { return (x - a) / c; }
};
ViewpointLine viewpoint_line(const glm::dvec3& viewpoint, const ReferencePlane& plane);

/// The upright camera with the same centre and heading; its columns are vertical planes of rays. Intrinsics are copied.
/// For a camera directed straight up or down, the heading is that of its up vector.
Camera upright_camera(const Camera& camera);

/// Maps homogeneous pixel positions of `from` to those of `to`; both must share their centre (a pure rotation).
glm::dmat3 pixel_in_to_from_pixel_in_from(const Camera& to, const Camera& from);

}  // namespace rs
