#pragma once
// An image of any projection: which ray each pixel position stands for; for lenses that bend lines. And a lens with an
// opening, whose pixels have many rays.

#include "rayspace/base/conventions.hpp"
#include "rayspace/light/directions.hpp"

#include <glm/glm.hpp>

#include <cmath>
#include <functional>

namespace rs::capture {

struct RayImage {
    int width = 0;  // px
    int height = 0;
    glm::dvec3 centre{0.0};              // all rays start here, in world coordinates
    glm::dvec3 forward{0.0, 0.0, -1.0};  // unit length; axial depth counts along it
    // Direction, of any length, through pixel position (x, y); called from several threads at once.
    std::function<glm::dvec3(double x, double y)> ray;
};

// Rays of one pixel leave from all over the opening and meet again at the distance that the lens is focused on: a point
// at axial distance z shows as a disc of `aperture * f_px * |z - focus| / (z * focus)` pixels across (R. Cook, T.
// Porter and L. Carpenter, "Distributed Ray Tracing", SIGGRAPH 1984).
struct ThinLens {
    double aperture = 0;  // diameter, in the scene's units; 0 = a pinhole, everything is sharp
    double focus = 1;     // axial distance of what is sharp, > 0

    struct Ray {
        glm::dvec3 origin, direction;  // not of unit length
    };
    // The ray from a place of the opening, `u` in [0, 1) each, that meets what `direction` from the centre meets in
    // focus. `forward` has unit length and is the lens' axis. Directions that lie behind it are those of a pinhole.
    [[nodiscard]] Ray through(const glm::dvec3& centre, const glm::dvec3& forward, const glm::dvec3& direction,
                              const glm::dvec2& u) const {
        const double along = glm::dot(direction, forward);
        if (!(along > 0)) return {centre, direction};
        const double radius = 0.5 * aperture * std::sqrt(u.x), turn = 2 * kPi * u.y;
        const Frame opening{glm::vec3(forward)};
        const glm::dvec3 at = centre + radius * (std::cos(turn) * glm::dvec3(opening.tangent) +
                                                 std::sin(turn) * glm::dvec3(opening.bitangent));
        const glm::dvec3 sharp = centre + direction * (focus / along);
        return {at, sharp - at};
    }
};

}  // namespace rs::capture
