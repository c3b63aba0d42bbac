#pragma once
// Tubes and bands: a circle or an ellipse swept along a path in space, for stems, wires, stitches, ribbons.

#include "capture/tracer/scene/scene.hpp"

#include <span>

namespace rs::synthetic {

struct SweepStyle {
    int sides = 12;                      // >= 3
    bool closed = false;                 // the path's end joins its start (which is not repeated)
    glm::vec3 facing{0.0F, 0.0F, 0.0F};  // the ellipse's short axis at the start, as near as the path allows; 0 = any
    float thickness = 1.0F;              // short axis / long axis of the cross-section
    float v_per_length = 1.0F;           // texture repeats along the path; rounded to an integer if closed
    bool rounded_ends = true;            // closes an open tube with half-ellipsoids
};

// `path`: at least 2 points (3 if closed), neighbours differ; `radii`: one per point, or a single one for all, > 0. The
// cross-section moves without twist (parallel transport; the remaining twist of a closed path is distributed evenly).
// Texture u runs once around.
void append_tube(capture::Mesh& mesh, std::span<const glm::vec3> path, std::span<const float> radii,
                 const SweepStyle& style = {});

// Hairs: thin bent ribbons that taper to a point, for fur.

struct Strand {
    glm::vec3 root{0.0F};
    glm::vec3 direction{0, 1, 0};  // unit length, at the root
    glm::vec3 bend{0.0F};          // the tip is at root + length * (direction + bend)
    glm::vec3 side{1, 0, 0};       // across the ribbon, roughly; not parallel to `direction`
    float length = 0.1F;
    float width = 0.005F;  // at the root
    float u = 0.5F;        // texture u of the whole strand; v runs from 0 at the root to 1 at the tip
};

// Appends 2 * segments - 1 triangles (segments >= 2). The normals fan out across the ribbon to shade like a round hair.
void append_strand(capture::Mesh& mesh, const Strand& strand, int segments);

}  // namespace rs::synthetic
