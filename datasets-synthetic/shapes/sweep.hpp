#pragma once
// Tubes and bands: a circle or an ellipse moved along a path in space. Stems, wires, stitches, ribbons.

#include "capture/tracer/scene/scene.hpp"

#include <span>

namespace rs::synthetic {

struct SweepStyle {
    int sides = 12;                      // >= 3
    bool closed = false;                 // the path's end joins its start (which is not repeated)
    glm::vec3 facing{0.0F, 0.0F, 0.0F};  // the ellipse's short axis at the start, as near as the path allows; 0 = any
    float thickness = 1.0F;              // short axis / long axis of the cross-section
    float v_per_length = 1.0F;           // texture repeats along the path; rounded to whole repeats where closed
    bool rounded_ends = true;            // half-ellipsoids close an open tube; else it stays open
};

// `path`: at least 2 points (3 where closed), neighbours differ; `radii`: one per point, or a single one for all, > 0.
// The cross-section is carried along without twist (parallel transport; where closed, the remaining twist is spread
// evenly). Texture u runs once around.
void append_tube(capture::Mesh& mesh, std::span<const glm::vec3> path, std::span<const float> radii,
                 const SweepStyle& style = {});

}  // namespace rs::synthetic
