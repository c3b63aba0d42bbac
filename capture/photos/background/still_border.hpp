#pragma once
// What is seen along the border of the still picture behind a turning object, where the object seldom comes: the first
// thing that is asked about a backdrop. Pixel coordinates are the still picture's.

#include "capture/photos/background/still_picture.hpp"

#include <algorithm>
#include <vector>

namespace rs::capture {

// Width of the border, a fiftieth of the shorter side.
inline int border_px(int width, int height) {
    return std::max(2, std::min(width, height) / 50);
}

// Calls `visit(x, y)` of every pixel of the border, row by row.
template <class Visit>
void for_border(int width, int height, Visit visit) {
    const int border = border_px(width, height);
    for (int y = 0; y < height; ++y) {
        const bool whole_row = y < border || y >= height - border;
        for (int x = 0; x < width; ++x) {
            if (!whole_row && x == border) x = std::max(border, width - border);
            visit(x, y);
        }
    }
}

// The few colours that the border consists of, commonest first; of what is still alone if `only_still`.
std::vector<Rgba8> border_colours(const StillPicture& still, bool only_still);

bool is_black(const Rgba8& colour);  // no channel above code 40

// Shares of the border's pixels.
struct BorderShares {
    double white = 0, black = 0;
    double bright = 0;  // still things that no black is, however it is lit
    double still = 0;   // agree over time

    // Most of it is. Before a black hardly anything bright stands still; `still_is_known`: of enough pictures.
    [[nodiscard]] bool is_white() const;
    [[nodiscard]] bool is_black(bool still_is_known) const;
};
BorderShares border_shares(const StillPicture& still);

}  // namespace rs::capture
