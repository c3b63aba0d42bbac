#pragma once
// Cartoon look of image-based objects, whose photos are not shaded by the scene's lights: the lightness of each pixel
// is reduced to a few tones, after edge-preserving smoothing, and the silhouette gets a line (H. Winnemoeller, S. C.
// Olsen and B. Gooch, Real-Time Video Abstraction, 2006). Pure; thread-safe.

#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <optional>
#include <vector>

namespace rs::compositor {

struct ObjectCartoon {
    // Lightnesses (CIE L* / 100) in [thresholds[i], thresholds[i - 1]) become values[i]; those below all thresholds the
    // last value. Thresholds descend within 1..0; there is one more value than thresholds.
    std::vector<float> thresholds;
    std::vector<float> values;
    glm::vec3 line_colour{0};            // linear
    std::optional<double> line_width{};  // scene units; nullopt: a pixel
};

/// \param image sRGB, straight alpha
/// \param pixel size of a screen pixel in the image, px, > 0; scales the smoothing
/// \param line_px width of the silhouette's line in the image, px; 0: none
Image<Rgba8> cartoon_of(const Image<Rgba8>& image, const ObjectCartoon& style, double pixel, double line_px);

}  // namespace rs::compositor
