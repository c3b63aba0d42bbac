#pragma once
// How true coded images are.

#include "encode/codec/source_image.hpp"
#include "rayspace/codec/dense_tile.hpp"

#include <functional>
#include <vector>

namespace rs::encode {

// dB, of R, G and B over all samples of the sources whose alpha is 128 or more. `reconstruction(view)`: the decoded
// samples; called from several threads. The same on any number of threads.
double coded_psnr(const std::vector<SourceImage>& sources, int width, int height, int alpha_bits,
                  const std::function<codec::ConstPlaneViews(std::size_t view)>& reconstruction);

}  // namespace rs::encode
