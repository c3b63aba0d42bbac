#include "capture/photos/masks/mask_statistics.hpp"

#include "rayspace/api/types/check.hpp"

#include <algorithm>
#include <numeric>

namespace rs::capture {
namespace {

// Codes that are neither black nor white, as blurred edges have them.
constexpr int kLeastGrey = 16;
constexpr int kLeastWhite = 240;

double share(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

std::uint64_t pixels_from(const CodeHistogram& histogram, int lowest) {
    RS_CHECK(lowest >= 0 && lowest <= 256);
    return std::accumulate(histogram.begin() + lowest, histogram.end(), std::uint64_t{0});
}

MaskStatistics mask_statistics(ConstImageView<Rgba8> mask) {
    constexpr int kBorderShare = 64;
    constexpr int kColoured = 48;
    RS_CHECK(!mask.empty());
    const int width = mask.width(), height = mask.height();
    const int border = std::max(1, std::min(width, height) / kBorderShare);
    MaskStatistics found;
    found.pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    for (int y = 0; y < height; ++y) {
        const bool is_border_row = y < border || y >= height - border;
        const bool is_centre_row = y >= height / 4 && y < height - height / 4;
        for (int x = 0; x < width; ++x) {
            const Rgba8& pixel = mask(x, y);
            const std::uint8_t grey = mask_grey(pixel);
            ++found.grey.whole[grey];
            ++found.alpha.whole[pixel.a];
            if (is_border_row || x < border || x >= width - border) {
                ++found.grey.border[grey];
                ++found.alpha.border[pixel.a];
            }
            if (is_centre_row && x >= width / 4 && x < width - width / 4) {
                ++found.grey.centre[grey];
                ++found.alpha.centre[pixel.a];
            }
            const auto [least, most] = std::minmax({pixel.r, pixel.g, pixel.b});
            found.coloured += pixel.a >= 128 && most - least > kColoured ? 1 : 0;
        }
    }
    return found;
}

bool has_transparency(const MaskStatistics& mask) {
    const std::uint64_t transparent = mask.pixels - pixels_from(mask.alpha.whole, 128);
    return transparent > 0 && transparent * 1000 >= mask.pixels;
}

int two_level_white(const CodeHistogram& histogram) {
    int white = 0;
    for (int code = 1; code < 256; ++code) {
        if (histogram[static_cast<std::size_t>(code)] == 0) continue;
        if (white != 0) return 255;
        white = code;
    }
    return white == 0 ? 255 : white;
}

bool is_photo(const MaskStatistics& mask) {
    constexpr double kMany = 0.05;
    const std::uint64_t grey = pixels_from(mask.grey.whole, kLeastGrey) - pixels_from(mask.grey.whole, kLeastWhite);
    // Masks of several classes are coloured, but flat: one code holds most of what is neither black nor white.
    const std::uint64_t commonest =
        *std::max_element(mask.grey.whole.begin() + kLeastGrey, mask.grey.whole.begin() + kLeastWhite);
    return share(mask.coloured, mask.pixels) > kMany && share(grey, mask.pixels) > kMany && commonest * 2 < grey;
}

bool looks_inverted(const ChannelStatistics& channel, int lowest_white) {
    constexpr double kMostOfBorder = 0.6;
    const double border = share(pixels_from(channel.border, lowest_white), pixels_from(channel.border, 0));
    const double centre = share(pixels_from(channel.centre, lowest_white), pixels_from(channel.centre, 0));
    return border >= kMostOfBorder && 1 - centre > 2 * (1 - border);
}

}  // namespace rs::capture
