#pragma once
/// \file
/// Colours and static pixels along the border of the background estimate, where the object seldom is: they determine
/// the kind of the background (background_model.hpp).

#include "capture/photos/background/background_estimate.hpp"
#include "capture/photos/background/background_parameters.hpp"

#include <algorithm>
#include <vector>

namespace rs::capture {

/// Width of the border in px: 1/50 of the shorter side, at least 2.
inline int border_px(int width, int height) {
    return std::max(2, std::min(width, height) / 50);
}

/// Calls `visit(x, y)` for every pixel of the border, row by row.
template <class Visit>
void for_border(int width, int height, Visit visit) {
    const int border = border_px(width, height);
    for (int y = 0; y < height; ++y) {
        const bool is_whole_row = y < border || y >= height - border;
        for (int x = 0; x < width; ++x) {
            if (!is_whole_row && x == border) x = std::max(border, width - border);
            visit(x, y);
        }
    }
}

/// Dominant colours of the border by k-means, the most frequent first; of its static pixels only if `only_static`.
/// Deterministic. Empty where there are fewer pixels than clusters.
std::vector<Rgba8> border_colours(const BackgroundEstimate& background, bool only_static,
                                  const BackgroundParameters::Border& parameters);

/// True if no channel is above Border::max_black_code.
bool is_black(const Rgba8& colour, const BackgroundParameters::Border& parameters);

/// Shares of the border's pixels, 0..1.
struct BorderStatistics {
    double white = 0;          ///< colour of the estimate is white
    double black = 0;          ///< is black
    double bright = 0;         ///< is static and brighter than a lit black
    double static_pixels = 0;  ///< frames agree

    [[nodiscard]] bool is_white(const BackgroundParameters::Border& parameters) const;
    /// `static_is_known`: there are enough frames. A dark room has bright static things, a black background
    /// hardly any.
    [[nodiscard]] bool is_black(bool static_is_known, const BackgroundParameters::Border& parameters) const;
};
BorderStatistics border_statistics(const BackgroundEstimate& background,
                                   const BackgroundParameters::Border& parameters);

}  // namespace rs::capture
