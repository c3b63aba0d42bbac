#pragma once
/// \file
/// Union of a turn's silhouettes: the silhouette of the volume that the object sweeps.
///
/// A full turn sweeps a body of revolution. Its silhouette is symmetric about the projected axis from every camera
/// position, also in perspective and from above, if the axis is vertical in the image.

#include "rayspace/image/image.hpp"

#include <optional>
#include <vector>

namespace rs::capture {

/// Accumulates the foreground images of all views. Pixel coordinates are those of the foreground images.
class TurnSilhouette {
public:
    TurnSilhouette(int width, int height);

    /// Adds the foreground image of one view, width x height px. Not thread-safe: use one object per thread and merge()
    /// them.
    void add(ConstImageView<Rgba8> foreground);
    void merge(const TurnSilhouette& other);

    /// Bounding box [left, right) x [top, bottom).
    struct Box {
        int left = 0, right = 0, top = 0, bottom = 0;  // px
        [[nodiscard]] bool empty() const { return left >= right; }
    };
    /// Bounding box of all pixels with alpha >= 8 in any view.
    [[nodiscard]] Box visible() const { return visible_; }

    struct Axis {
        double x_px = 0;       ///< column of the projected axis
        double spread_px = 0;  ///< median absolute deviation of the rows from x_px
    };
    /// Median over the rows of the middle between the leftmost and the rightmost pixel with alpha >= 128 in any view.
    /// Rows that touch the left or right image border are excluded. nullopt if fewer than 8 rows remain.
    [[nodiscard]] std::optional<Axis> axis() const;

private:
    int width_ = 0;
    std::vector<int> left_, right_;  // [row], first and last pixel with alpha >= 128; left_ > right_: none
    Box visible_;
};

}  // namespace rs::capture
