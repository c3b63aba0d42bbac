#pragma once
// Input and result of the image encoders: the planes of each photo at the coded size with the mask of valid samples,
// and the coded images with their fidelity.

#include "rayspace/codec/code/coded_images.hpp"
#include "rayspace/codec/code/dense_code.hpp"
#include "rayspace/codec/dense_tile.hpp"
#include "rayspace/image/image.hpp"

#include <array>
#include <cstdint>
#include <span>
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

struct EncodedImages {
    codec::CodedImages coded;
    double psnr_db = 0;  // coded_psnr_db() against the sources
};

/// Squared error of R, G and B over samples with alpha of 128 or more.
struct CodedError {
    std::int64_t squares = 0;
    std::int64_t samples = 0;  // each of R, G and B counts
};

/// Error of the decoded samples of an image of width x height pixels.
CodedError measure_coded_error(const SourceImage& source, const codec::ConstPlaneViews& decoded, int width, int height,
                               int alpha_bits);

/// PSNR in dB of all images together.
double coded_psnr_db(std::span<const CodedError> errors);

}  // namespace rs::encode
