#pragma once
// Ellipsoids and random points on them.

#include "capture/tracer/scene/scene.hpp"
#include "datasets-synthetic/shapes/frame.hpp"
#include "datasets-synthetic/shapes/random.hpp"

namespace rs::synthetic {

struct Ellipsoid {
    Frame frame;            // centre and axes
    glm::vec3 radii{1.0F};  // along the frame's x, y, z, > 0

    // Distance from the centre relative to the surface's distance in the same direction: 1 on the surface, less inside.
    [[nodiscard]] float level(glm::vec3 p) const { return glm::length(frame.point_in_part(p) / radii); }
};

// Appends an ellipsoid with poles on the frame's Y axis. Texture u runs once around from the frame's +Z, v from the
// lower to the upper pole. `columns` >= 3, `rows` >= 2.
void append_ellipsoid(capture::Mesh& mesh, const Ellipsoid& ellipsoid, int columns, int rows);

struct SurfacePoint {
    glm::vec3 position;
    glm::vec3 normal;  // outward, unit length
};

// Result of one step of rejection sampling. Kept points are uniform by area.
struct RejectionSample {
    SurfacePoint point;
    bool keep = false;
};
RejectionSample sample_surface(const Ellipsoid& ellipsoid, Random& random);

// Selection weight of an ellipsoid that makes the density of kept points the same for all ellipsoids.
float sampling_weight(const Ellipsoid& ellipsoid);

}  // namespace rs::synthetic
