#pragma once
// An image as the encoder sees it: planes of the coded size, and which samples are valid.

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

// `image` has straight alpha. The coded size is its own, rounded up to a multiple of 16.
SourceImage source_image(ConstImageView<Rgba8> image, int alpha_bits);

// The same image with alpha in another number of bits.
void set_alpha_bits(SourceImage& source, int alpha_bits);

// The mean alpha, off 0 or 255, beside the edges of masks of one bit.
codec::EdgeAlpha usual_edge_alpha(const std::vector<SourceImage>& sources);

// Weights of squared errors of Y, U and V that make up the squared error of R, G and B together (BT.601), but for the
// products of different planes' errors: 3, 1.772^2 + 0.344^2, 1.402^2 + 0.714^2.
inline constexpr std::array<float, 3> kPlaneWeights = {3.0F, 3.258F, 2.476F};

}  // namespace rs::encode
