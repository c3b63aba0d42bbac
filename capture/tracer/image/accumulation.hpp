#pragma once
// Samples of an image and their sums.

#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

namespace rs::capture {

// Pixels [x0, x1) x [y0, y1).
struct PixelRectangle {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};
PixelRectangle overlap(const PixelRectangle& a, const PixelRectangle& b);

// The first surface on a ray's way that is no mirror and no glass.
struct Guide {
    glm::vec3 place, normal, colour;
    float distance;  // that the ray came
};

// What arrived along a ray.
struct RadianceSample {
    glm::vec3 radiance{0.0F};
    bool met = false;
    bool guided = false;
    Guide guide{};  // where `guided`
};

struct GuideSum {
    Guide sum{};
    float count = 0.0F;    // of guides
    float squares = 0.0F;  // of the luminance of all samples
};

// An image that gains samples: sums, so that passes of one sample each and one pass of as many give the same bits.
struct Accumulation {
    Image<RgbaF> sum;        // radiance of the camera rays that met a surface; alpha counts them
    int samples = 0;         // of each pixel so far
    Image<GuideSum> guides;  // empty where the method gives none

    // Of a ray that met something. Not from several threads for one pixel.
    void add(int x, int y, const RadianceSample& arrived);
    // As far as it lies in a part of the image, which is not empty and not larger than it.
    [[nodiscard]] Accumulation cut_out(const PixelRectangle& part) const;
    // Linear light, straight alpha = share of camera rays that hit a surface.
    [[nodiscard]] Image<RgbaF> mean() const&;
    [[nodiscard]] Image<RgbaF> mean() &&;
};

}  // namespace rs::capture
