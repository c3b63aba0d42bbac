#pragma once
// Histograms of the masks of a folder, from which its interpretation is derived: the channel, the code for white,
// inverted or not. A rule is applied to the folder as a whole, so that all masks are interpreted alike.

#include "rayspace/image/image.hpp"

#include <array>
#include <cstdint>
#include <span>

namespace rs::capture {

using CodeHistogram = std::array<std::uint64_t, 256>;  // pixels by code

/// Sum of the codes lowest..255.
std::uint64_t pixels_from(const CodeHistogram& histogram, int lowest);

/// One channel of a mask.
struct ChannelStatistics {
    CodeHistogram whole{};
    CodeHistogram border{};  ///< the outermost 1/64 of the shorter side, at least a pixel
    CodeHistogram centre{};  ///< the middle half of the width and of the height
};

struct MaskStatistics {
    ChannelStatistics grey;   ///< of mask_grey()
    ChannelStatistics alpha;  ///< straight alpha
    std::uint64_t pixels = 0;
    std::uint64_t coloured = 0;  ///< opaque pixels whose channels differ by more than 48
};

/// Grey value of a mask pixel: the largest of red, green and blue, composited over black.
inline std::uint8_t mask_grey(const Rgba8& pixel) {
    const int brightest =
        pixel.r > pixel.g ? (pixel.r > pixel.b ? pixel.r : pixel.b) : (pixel.g > pixel.b ? pixel.g : pixel.b);
    return static_cast<std::uint8_t>((brightest * pixel.a + 127) / 255);
}

/// \param mask not empty. Pure; thread-safe.
MaskStatistics mask_statistics(ConstImageView<Rgba8> mask);

/// Has transparency: at least one pixel of a thousand has an alpha below 128.
bool has_transparency(const MaskStatistics& mask);

/// The code for white in masks that hold 0 and one other code below 255; 255 for all others.
/// \param histogram of all masks together.
int two_level_white(const CodeHistogram& histogram);

/// Is a photo rather than a mask: many pixels are coloured, and neither black nor white.
bool is_photo(const MaskStatistics& mask);

/// Looks inverted: most of the border is white, and the share of black in the centre is more than twice that at the
/// border. `lowest_white` is the least code that counts as white.
bool looks_inverted(const ChannelStatistics& channel, int lowest_white);

}  // namespace rs::capture
