#include "capture/photos/matte/still_at_border.hpp"

#include "capture/photos/background/still_border.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "capture/photos/intake/survey.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace rs::capture {

bool is_still_at_border(std::span<const Image<Rgba8>> cuts) {
    constexpr std::size_t kFewestViews = 6;
    constexpr double kMost = 0.7;
    constexpr double kFewestOfBorder = 0.02;
    constexpr int kSame_codes = 24;  // exposures differ
    if (cuts.size() < kFewestViews) return false;
    const int width = cuts[0].width(), height = cuts[0].height();
    const double most = kMost * static_cast<double>(cuts.size());
    int border = 0, covered = 0, still = 0;  // pixels
    std::vector<Rgba8> seen;
    for_border(width, height, [&](int x, int y) {
        ++border;
        seen.clear();
        for (const Image<Rgba8>& view : cuts) {
            if (view(x, y).a >= 128) seen.push_back(view(x, y));
        }
        if (static_cast<double>(seen.size()) < most) return;
        ++covered;
        const Rgba8 usual = median_colour(seen);
        const auto same =
            std::ranges::count_if(seen, [&](const Rgba8& c) { return within_codes(c, usual, kSame_codes); });
        still += static_cast<double>(same) >= most ? 1 : 0;
    });
    return covered > kFewestOfBorder * border && 2 * still > covered;
}

}  // namespace rs::capture
