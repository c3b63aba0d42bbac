#pragma once
// Ray geometry, in floating point: a ray <-> (plane, x, u), a viewpoint as a line of ray space, vertical compensation,
// and the rectification of cameras that look down. Used offline and in tests; the renderer's integer form of the same
// formulas is engine/RECONSTRUCTION.md.
//
// Source: Sakagawa, Katayama, Kotake, Tamura, "A Hardware Ray-Space Data Renderer for Interactive Augmented
// Virtuality", section 2, equations 1 and 2. All functions are pure and may be called from any thread.

#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

#include <optional>

namespace rs {

// Reference plane k of `count`: it contains the Y axis, and is a mirror image of itself seen from behind (k + count/2).
struct ReferencePlane {
    glm::dvec3 normal;   // n_k = (sin t, 0, cos t), t = 2 pi k / count
    glm::dvec3 tangent;  // t_k = (cos t, 0, -sin t)
};
ReferencePlane reference_plane(int k, int count);

struct Ray {
    glm::dvec3 origin;
    glm::dvec3 direction;  // any length but 0
};

// The plane that a ray of this direction crosses most squarely: the largest -direction . n_k (lowest k among equals).
int most_square_plane(const glm::dvec3& direction, int count);

// A ray in ray space. x and y: where it crosses the plane, along the tangent and in height. u: tangent of the angle
// between its horizontal part and the plane's normal, so that x = a + u c for a viewpoint (a, b, c) in the plane's
// frame. slope: rise per unit of travel along -normal. Of these the paper's ray space keeps x and u.
struct PlaneRay {
    double x = 0;
    double u = 0;
    double y = 0;
    double slope = 0;
};

// Nothing where the ray does not run against the plane's normal (it is parallel, or crosses from behind).
std::optional<PlaneRay> to_ray_space(const Ray& ray, const ReferencePlane& plane);
// The ray as seen from distance c in front of the plane: origin = (x - u c) t + (y - slope c) Y + c n.
Ray from_ray_space(const PlaneRay& ray, const ReferencePlane& plane, double c);

// A viewpoint in the frame of a plane: a along the tangent, b in height, c along the normal. Its rays are the line
// x = a + u c of the (x, u) plane (equation 1).
struct ViewpointLine {
    double a = 0;
    double b = 0;
    double c = 0;
    [[nodiscard]] double x_at(double u) const { return a + u * c; }
    [[nodiscard]] double u_at(double x) const { return (x - a) / c; }
};
ViewpointLine viewpoint_line(const glm::dvec3& viewpoint, const ReferencePlane& plane);

// Vertical compensation (equation 2, generalised to cameras at any height): a view ray at vertical slope s_p over axial
// depth l_p from height b_p meets the plane at Y = b_p + s_p l_p; the slope at which a camera at height b_q and axial
// depth l_q sees that point. With b_p = b_q = 0 this is the paper's h_q = (l_p / l_q) h_p.
constexpr double compensated_slope(double s_p, double b_p, double l_p, double b_q, double l_q) {
    return (b_p + s_p * l_p - b_q) / l_q;
}

// The upright camera with the same centre and heading: its columns are vertical planes of rays. Intrinsics are copied.
// The heading of a camera that looks straight up or down is that of its up vector.
Camera upright_camera(const Camera& camera);

// Takes homogeneous pixel positions of `from` to those of `to`; both must share their centre (a pure rotation).
glm::dmat3 pixel_in_to_from_pixel_in_from(const Camera& to, const Camera& from);

}  // namespace rs
