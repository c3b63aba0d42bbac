#pragma once
// Radiance samples of an image and their sums.

#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

namespace rs::capture {

// Pixels [x0, x1) x [y0, y1).
struct PixelRectangle {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};
PixelRectangle overlap(const PixelRectangle& a, const PixelRectangle& b);

// Denoising guide: the first surface along a path that is neither mirror nor glass.
struct Guide {
    glm::vec3 position, normal, colour;
    float distance;  // length of the path to it
};

// Result of tracing one camera ray.
struct RadianceSample {
    glm::vec3 radiance{0.0F};
    bool hit = false;  // of a surface or a light
    bool has_guide = false;
    Guide guide{};  // valid if has_guide
};

struct GuideSum {
    Guide sum{};
    float count = 0.0F;    // number of guides
    float squares = 0.0F;  // sum of the squared luminance of all samples
};

// Progressive image. Stores sums, so that the result does not depend on how samples are divided into passes.
struct Accumulation {
    Image<RgbaF> sum;        // radiance of the camera rays with a hit; alpha is their number
    int samples = 0;         // per pixel
    Image<GuideSum> guides;  // empty if the method has none

    // Adds a sample with a hit. Not thread-safe for the same pixel.
    void add(int x, int y, const RadianceSample& sample);
    // Copy of a non-empty rectangle inside the image.
    [[nodiscard]] Accumulation crop(const PixelRectangle& part) const;
    // Linear light, straight alpha = share of camera rays that hit a surface.
    [[nodiscard]] Image<RgbaF> mean() const&;
    [[nodiscard]] Image<RgbaF> mean() &&;
};

}  // namespace rs::capture
