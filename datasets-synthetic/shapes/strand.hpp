#pragma once
// Hairs: thin bent ribbons that taper to a point, for fur.

#include "capture/tracer/scene/scene.hpp"

namespace rs::synthetic {

struct Strand {
    glm::vec3 root{0.0F};
    glm::vec3 direction{0, 1, 0};  // unit length, at the root
    glm::vec3 bend{0.0F};          // the tip stands at root + length * (direction + bend)
    glm::vec3 side{1, 0, 0};       // across the ribbon, roughly; not parallel to `direction`
    float length = 0.1F;
    float width = 0.005F;  // at the root
    float u = 0.5F;        // texture u of the whole strand; v runs from 0 at the root to 1 at the tip
};

// 2 * segments - 1 triangles (segments >= 2). The normals fan out across the ribbon, so that it shades like a round
// hair.
void append_strand(capture::Mesh& mesh, const Strand& strand, int segments);

}  // namespace rs::synthetic
