#pragma once
// How a scene looks when it is drawn as a cartoon: in few tones, with lines along its edges. Source: N. Burnett and T.
// Piazza, "Toon Shading Using Distributed Raytracing"; how it is drawn stands in integrator/toon.hpp.

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace rs::capture {

struct ToonStyle {
    static constexpr std::size_t kMostTones = 16;

    // An intensity of thresholds[i] or more, but less than thresholds[i - 1], has the tone values[i]; less than all of
    // them, the last. Thresholds fall from 1 to 0; there is one value more than there are thresholds.
    std::vector<float> thresholds{0.95F, 0.5F, 0.3F, 0.05F};
    std::vector<float> values{1.0F, 0.8F, 0.5F, 0.3F, 0.1F};  // factors on the surface's colour, 0..1

    // Lengths are in the scene's units.
    float edge_radius = 0.008F;       // how far from an edge its line reaches; 0 = no lines
    float edge_depth = 0.0F;          // jumps of the depth that are edges; 0 = twice the radius
    float edge_angle_rad = 0.52360F;  // turns of the surface within the radius that are edges: 30 degrees
    glm::vec3 edge_colour{0.0F};      // linear

    // Areas, and surfaces that shine, light from as many places of theirs, so that their shadows have steps of their
    // own; 0 = from their middle, and shadows are hard.
    int shadow_rays = 0;

    // On all that is drawn: what a later exposure takes away again.
    float brightness = 1.0F;

    [[nodiscard]] float tone(float intensity) const {
        std::size_t step = 0;
        while (step < thresholds.size() && intensity < thresholds[step]) ++step;
        return values[step];
    }
};

}  // namespace rs::capture
