#pragma once
// Alpha codebook of the board profile: 256 patterns of 4x4 samples.

#include "encode/codec/board/vector_quantiser.hpp"
#include "encode/codec/source_image.hpp"

#include <cstdint>
#include <vector>

namespace rs::encode {

struct AlphaCodebook {
    Codebook book;  // `samples` minus 128
    std::vector<std::uint8_t>
        samples;  // as stored: [entry * 16 + 4 row + column], values that alpha_bits can represent
    int alpha_bits = 2;

    /// The index of the entry nearest to the 4x4 samples at (x, y).
    [[nodiscard]] unsigned nearest(const SourceImage& source, int x, int y) const;
};

/// Trains the codebook on the quarters of partly covered blocks. Entry 0 is fully covered, entry 1 fully transparent.
AlphaCodebook train_alpha(const std::vector<SourceImage>& sources, int alpha_bits);

}  // namespace rs::encode
