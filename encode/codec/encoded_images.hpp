#pragma once
// Result of an image encoder, and its fidelity.

#include "encode/codec/source_image.hpp"
#include "rayspace/codec/code/coded_images.hpp"
#include "rayspace/codec/dense_tile.hpp"

#include <functional>
#include <vector>

namespace rs::encode {

struct EncodedImages {
    codec::CodedImages coded;
    double psnr_db = 0;  // measure_coded_psnr() against the sources
};

/// PSNR in dB of R, G and B over all samples of the sources with alpha of 128 or more. Does not depend on the number of
/// threads.
/// \param reconstruction  returns the decoded samples of a view; called from several threads.
double measure_coded_psnr(const std::vector<SourceImage>& sources, int width, int height, int alpha_bits,
                          const std::function<codec::ConstPlaneViews(std::size_t view)>& reconstruction);

}  // namespace rs::encode
