#pragma once
// What the cut-outs of a turn cover together: the outline of the body that the object sweeps. A full turn sweeps a body
// of revolution, whose outline is symmetric about the axis wherever the camera stands, also in perspective and from
// above, as long as the axis is vertical in the picture.

#include "rayspace/image/image.hpp"

#include <optional>
#include <vector>

namespace rs::capture {

class TurnOutline {
public:
    TurnOutline(int width, int height);

    // Adds the cut-out of one view. Not thread-safe; merge() outlines that were collected in several threads.
    void add(ConstImageView<Rgba8> cut_out);
    void merge(const TurnOutline& other);

    // Rectangle of all pixels that any view shows (alpha of 8 and more), as [left, right) x [top, bottom); empty where
    // left >= right.
    struct Box {
        int left = 0, right = 0, top = 0, bottom = 0;  // px
        [[nodiscard]] bool empty() const { return left >= right; }
    };
    [[nodiscard]] Box visible() const { return visible_; }

    // The axis' column in px: the median over the rows of the middle between the leftmost and the rightmost solid pixel
    // (alpha of 128 and more) of the whole turn. Rows that reach the picture's side are left out. No value where fewer
    // than 8 rows are left. `spread_px` is the rows' median deviation from it: the doubt.
    struct Axis {
        double x_px = 0;
        double spread_px = 0;
    };
    [[nodiscard]] std::optional<Axis> axis() const;

private:
    int width_ = 0;
    std::vector<int> left_, right_;  // [row], solid pixels; left_ > right_ where there are none
    Box visible_;
};

}  // namespace rs::capture
