#pragma once
// Style of toon shading: tones and edge lines. Source: N. Burnett and T. Piazza, "Toon Shading Using Distributed
// Raytracing"; implemented in integrator/toon.hpp.

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace rs::capture {

struct ToonStyle {
    static constexpr std::size_t kMaxTones = 16;
    // `colour` and `depth` are the variants that the paper rejects, for comparison only. `colour` infers the intensity
    // from the traced radiance, once per camera ray: it is the largest component, which depends on the brightness of
    // lights and surfaces. `depth` takes any depth difference for an edge, also on steep planes, and finds no creases.
    enum class Steps { intensity, colour };
    enum class EdgeTest { slope, depth };

    // Intensities in [thresholds[i], thresholds[i - 1]) have the tone values[i], intensities below all thresholds the
    // last value. Thresholds descend within 1..0; there is one more value than thresholds.
    std::vector<float> thresholds{0.95F, 0.5F, 0.3F, 0.05F};
    std::vector<float> values{1.0F, 0.8F, 0.5F, 0.3F, 0.1F};  // factors on the surface's colour, 0..1
    Steps steps = Steps::intensity;

    // Lengths are in the scene's units.
    float edge_radius = 0.008F;       // width of the line beside an edge; 0 = no lines
    float edge_depth = 0.0F;          // depth discontinuity that is an edge; 0 = twice the radius
    float edge_angle_rad = 0.52360F;  // change of the normal within the radius that is an edge: 30 degrees
    glm::vec3 edge_colour{0.0F};      // linear
    EdgeTest edge_test = EdgeTest::slope;

    // Samples per area light and emissive surface, for soft shadows with tone steps; 0 = their centre, for hard
    // shadows.
    int shadow_rays = 0;

    // Factor on the image, to compensate for a later exposure.
    float brightness = 1.0F;

    [[nodiscard]] float tone(float intensity) const {
        std::size_t step = 0;
        while (step < thresholds.size() && intensity < thresholds[step]) ++step;
        return values[step];
    }
};

}  // namespace rs::capture
