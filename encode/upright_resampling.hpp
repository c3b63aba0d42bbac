#pragma once
// Resampling a picture to another camera at the same centre.

#include "rayspace/camera.hpp"
#include "rayspace/image.hpp"

#include <glm/glm.hpp>

namespace rs::encode {

struct PixelBox {  // [x0, x1) x [y0, y1) in continuous pixel positions; empty where x1 <= x0
    double x0 = 1e30, y0 = 1e30, x1 = -1e30, y1 = -1e30;
    [[nodiscard]] bool empty() const { return x1 <= x0 || y1 <= y0; }
    void include(const PixelBox& other);
    void include(double x, double y);
};

// The bounding box of pixels with alpha above 0.
PixelBox occupied_box(ConstImageView<Rgba8> picture);

// The bounding box of `box` seen by another camera with the same centre. Both cameras must look at it.
PixelBox box_seen_by(const Camera& to, const Camera& from, const PixelBox& box);

// The picture of `from` as `to` sees it (same centre): Catmull-Rom on premultiplied linear light, transparent outside
// of the frame. Meant for scales near 1: it does not prefilter.
Image<Rgba8> resampled_picture(const Camera& to, const Camera& from, ConstImageView<Rgba8> picture);

}  // namespace rs::encode
