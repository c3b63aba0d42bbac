#pragma once
// The codebook of coverage of the board profile: 256 patterns of 4x4 samples of alpha.

#include "encode/codec/board/vector_quantiser.hpp"
#include "encode/codec/source_image.hpp"

#include <cstdint>
#include <vector>

namespace rs::encode {

struct AlphaBook {
    TrainedBook book;                   // of the same numbers less 128
    std::vector<std::uint8_t> samples;  // as stored: [entry * 16 + 4 row + column], values that alpha_bits bits have
    int alpha_bits = 2;

    // Of the 4x4 samples at (x, y).
    [[nodiscard]] unsigned nearest(const SourceImage& source, int x, int y) const;
};

// Trained on the quarters of blocks that are partly covered. Entry 0 is fully covered, entry 1 not at all.
AlphaBook train_alpha(const std::vector<SourceImage>& sources, int alpha_bits);

}  // namespace rs::encode
