#pragma once
// Conversion between rays and (plane, x, u), and vertical compensation, as in the paper; the reference for tests of
// maps and images.
//
// Source: Sakagawa, Katayama, Kotake, Tamura, "A Hardware Ray-Space Data Renderer for Interactive Augmented
// Virtuality", section 2, equations 1 and 2.

#include "rayspace/geometry/ray_space.hpp"

#include <optional>

namespace rs::test {

struct Ray {
    glm::dvec3 origin;
    glm::dvec3 direction;  // any length but 0
};

/// The plane most perpendicular to a ray: the largest -direction . n_k (lowest k among equals).
inline int most_perpendicular_plane(const glm::dvec3& direction, int count) {
    int best = 0;
    double best_squareness = -glm::dot(direction, reference_plane(0, count).normal);
    for (int k = 1; k < count; ++k) {
        const double squareness = -glm::dot(direction, reference_plane(k, count).normal);
        if (squareness > best_squareness) {
            best = k;
            best_squareness = squareness;
        }
    }
    return best;
}

/// A ray in ray space. x and y: intersection with the plane, along the tangent and in height. u: tangent of the angle
/// between its horizontal part and the plane's normal, so that x = a + u c for a viewpoint (a, b, c) in the plane's
/// frame. slope: rise per unit of travel along -normal. The paper's ray space uses only x and u.
struct PlaneRay {
    double x = 0;
    double u = 0;
    double y = 0;
    double slope = 0;
};

/// Converts a ray; nullopt if it is parallel to the plane or crosses it from behind.
inline std::optional<PlaneRay> to_ray_space(const Ray& ray, const ReferencePlane& plane) {
    const double against = -glm::dot(ray.direction, plane.normal);
    if (against <= 0) return std::nullopt;
    const ViewpointLine line = viewpoint_line(ray.origin, plane);
    PlaneRay result;
    result.u = glm::dot(ray.direction, plane.tangent) / against;
    result.slope = ray.direction.y / against;
    result.x = line.a + result.u * line.c;
    result.y = line.b + result.slope * line.c;
    return result;
}

/// Converts back, with the origin at distance c in front of the plane: origin = (x - u c) t + (y - slope c) Y + c n.
inline Ray from_ray_space(const PlaneRay& ray, const ReferencePlane& plane, double c) {
    const glm::dvec3 up(0, 1, 0);
    return {(ray.x - ray.u * c) * plane.tangent + (ray.y - ray.slope * c) * up + c * plane.normal,
            ray.u * plane.tangent + ray.slope * up - plane.normal};
}

/// Vertical compensation (equation 2, generalised to cameras at any height): a view ray of vertical slope s_p over
/// axial depth l_p from height b_p meets the plane at Y = b_p + s_p l_p. Returns the slope of that point from a camera
/// at height b_q and axial depth l_q. With b_p = b_q = 0 this is the paper's h_q = (l_p / l_q) h_p.
constexpr double compensated_slope(double s_p, double b_p, double l_p, double b_q, double l_q) {
    return (b_p + s_p * l_p - b_q) / l_q;
}

}  // namespace rs::test
