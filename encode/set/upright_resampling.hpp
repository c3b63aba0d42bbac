#pragma once
// Resamples an image to another camera at the same centre.

#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <optional>

namespace rs::encode {

/// [x0, x1) x [y0, y1) in continuous pixel positions; empty if x1 <= x0 or y1 <= y0.
struct PixelBox {
    double x0 = 1e30, y0 = 1e30, x1 = -1e30, y1 = -1e30;
    [[nodiscard]] bool empty() const { return x1 <= x0 || y1 <= y0; }
    void include(double x, double y);
    [[nodiscard]] PixelBox moved(double dx, double dy) const { return {x0 + dx, y0 + dy, x1 + dx, y1 + dy}; }
};

/// The bounding box of pixels with alpha above 0.
PixelBox find_occupied_box(ConstImageView<Rgba8> image);

/// The bounding box of an image's visible pixels, in pixels of another camera at the same centre. nullopt if part of it
/// is behind that camera.
std::optional<PixelBox> project_occupied_box(const Camera& to, const Camera& from, ConstImageView<Rgba8> image);

/// Resamples the image of `from` to `to` (same centre): Catmull-Rom on premultiplied linear light, transparent outside
/// of the frame. For scales near 1: there is no prefilter.
Image<Rgba8> resample_image(const Camera& to, const Camera& from, ConstImageView<Rgba8> image);

}  // namespace rs::encode
