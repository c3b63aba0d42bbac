#pragma once
// What may be a part of the turning object although it never changes: one of revolution about the turntable's axis, as
// the body of a teapot is. It looks as still as what stands behind the object, but it looks the same on both sides of
// the axis, in some light, and between its two outlines a row of it shows nothing but itself. What is drawn on it
// moves, some of it stands still, and that is more even than a room is beside the object, but for highlights.

#include "capture/photos/background/still_picture.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <vector>

namespace rs::capture {

class RevolutionRows {
public:
    // `untouched`, in the still picture's size, is not 0 where the object never comes; `axis_px` is the axis' column.
    RevolutionRows(const StillPicture& still, ConstImageView<std::uint8_t> untouched, double axis_px);

    // Whether the row lets pixel (x, y) be one of such a body, which then reaches from there to the other side. Where
    // the rows around show an even backdrop beside the object, they say nothing against it.
    [[nodiscard]] bool may_be_body(int x, int y) const;

    // Calls `look(u)` of the columns where the other side of column x may be seen, the likeliest first, until one is
    // what was looked for; whether one is.
    template <class Look>
    [[nodiscard]] bool any_mirrored(int x, Look look) const {
        constexpr int kReach_px = 3;  // the axis is not known better
        for (const int shift : {0, -kReach_px, kReach_px}) {
            const int u = mirrored(x) + shift;
            if (u >= 0 && u < edges_.width() - 1 && look(u)) return true;
        }
        return false;
    }

private:
    [[nodiscard]] int mirrored(int x) const { return twice_axis_px_ - 1 - x; }

    int twice_axis_px_;
    // Pixels that stand still, and edges between those, left of this pixel in its row; one column more.
    Image<int> still_, edges_;
    std::vector<double> edges_beside_;  // [row] per pixel of what is untouched there and in rows near by
};

}  // namespace rs::capture
