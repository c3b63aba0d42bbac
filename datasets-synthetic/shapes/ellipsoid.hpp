#pragma once
// Ellipsoids: beads, eyes, limbs, fruit; and random points on them.

#include "capture/tracer/scene/scene.hpp"
#include "datasets-synthetic/shapes/frame.hpp"
#include "datasets-synthetic/shapes/random.hpp"

namespace rs::synthetic {

struct Ellipsoid {
    Frame frame;            // centre and axes
    glm::vec3 radii{1.0F};  // along the frame's x, y, z, > 0

    // 1 on the surface, less inside: the distance from the centre in units of the surface's in that direction.
    [[nodiscard]] float level(glm::vec3 p) const { return glm::length(frame.point_in_part(p) / radii); }
};

// Poles on the frame's Y axis. Texture u runs once around from the frame's +Z, v from the lower pole to the upper one.
// `columns` >= 3, `rows` >= 2.
void append_ellipsoid(capture::Mesh& mesh, const Ellipsoid& ellipsoid, int columns, int rows);

struct SurfacePoint {
    glm::vec3 position;
    glm::vec3 normal;  // outward, unit length
};

// A rejection sampler's draw: a random point, and whether to keep it. Kept points are uniform by area.
struct SurfaceDraw {
    SurfacePoint point;
    bool keep = false;
};
SurfaceDraw draw_point(const Ellipsoid& ellipsoid, Random& random);

// The expected number of draws per unit of area is the same for all ellipsoids if they are chosen with this weight.
float draw_weight(const Ellipsoid& ellipsoid);

}  // namespace rs::synthetic
