#pragma once
// How true coded pictures are.

#include "encode/codec/source_picture.hpp"
#include "rayspace/codec/dense_tile.hpp"

#include <functional>
#include <vector>

namespace rs::encode {

// dB, of R, G and B over all samples of the sources whose alpha is 128 or more. `reconstruction(view)`: the decoded
// samples; called from several threads. The same on any number of threads.
double coded_psnr(const std::vector<SourcePicture>& sources, int width, int height, int alpha_bits,
                  const std::function<codec::ConstPlaneViews(std::size_t view)>& reconstruction);

}  // namespace rs::encode
