#pragma once
// Image of an arbitrary projection, given by one ray per pixel position (for lens distortion), and a thin lens for
// depth of field.

#include "rayspace/base/conventions.hpp"
#include "rayspace/light/directions.hpp"

#include <glm/glm.hpp>

#include <cmath>
#include <functional>

namespace rs::capture {

struct RayImage {
    int width = 0;  // px
    int height = 0;
    glm::dvec3 centre{0.0};              // origin of all rays, in world coordinates
    glm::dvec3 forward{0.0, 0.0, -1.0};  // unit length; axis of axial depths
    // Direction of any length through pixel position (x, y); must be thread-safe.
    std::function<glm::dvec3(double x, double y)> ray;
};

// Rays of one pixel start at points of the aperture and converge at the focus distance: a point at axial distance z
// appears as a disc with a diameter of `aperture * f_px * |z - focus| / (z * focus)` pixels (R. Cook, T. Porter and
// L. Carpenter, "Distributed Ray Tracing", SIGGRAPH 1984).
struct ThinLens {
    double aperture = 0;  // diameter, in the scene's units; 0 = pinhole
    double focus = 1;     // axial focus distance, > 0

    struct Ray {
        glm::dvec3 origin, direction;  // not of unit length
    };
    /// Ray from a random point of the aperture through the focus point of the pinhole ray. Directions behind the lens
    /// yield the pinhole ray.
    /// \param forward the lens axis, unit length
    /// \param u each in [0, 1)
    [[nodiscard]] Ray through(const glm::dvec3& centre, const glm::dvec3& forward, const glm::dvec3& direction,
                              const glm::dvec2& u) const {
        const double along = glm::dot(direction, forward);
        if (!(along > 0)) return {centre, direction};
        const double radius = 0.5 * aperture * std::sqrt(u.x), turn = 2 * kPi * u.y;
        const Frame lens{glm::vec3(forward)};
        const glm::dvec3 origin =
            centre + radius * (std::cos(turn) * glm::dvec3(lens.tangent) + std::sin(turn) * glm::dvec3(lens.bitangent));
        const glm::dvec3 focus_point = centre + direction * (focus / along);
        return {origin, focus_point - origin};
    }
};

}  // namespace rs::capture
