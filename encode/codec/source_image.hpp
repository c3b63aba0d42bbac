#pragma once
// Encoder input image: planes of the coded size and the mask of valid samples.

#include "rayspace/codec/code/dense_code.hpp"
#include "rayspace/image/image.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace rs::encode {

struct SourceImage {
    std::array<Image<std::uint8_t>, 3> planes;  // Y, U, V at full size
    Image<std::uint8_t> coverage;               // alpha, 0 .. 255
    Image<std::uint8_t> alpha;                  // levels 0 .. 2^bits - 1
    Image<std::uint8_t> valid;                  // 255 where the alpha level is not 0, else 0
};

/// Converts an image with straight alpha. The coded size is its size rounded up to a multiple of 16.
SourceImage source_image(ConstImageView<Rgba8> image, int alpha_bits);

/// Requantises alpha to another number of bits.
void set_alpha_bits(SourceImage& source, int alpha_bits);

/// Mean distance of alpha from 0 or 255 beside the edges of 1-bit masks.
codec::EdgeAlpha estimate_edge_alpha(const std::vector<SourceImage>& sources);

/// Weights of squared errors of Y, U and V in the sum of squared errors of R, G and B (BT.601), without the cross
/// terms: 3, 1.772^2 + 0.344^2, 1.402^2 + 0.714^2.
inline constexpr std::array<float, 3> kPlaneWeights = {3.0F, 3.258F, 2.476F};

}  // namespace rs::encode
