#pragma once
// JPEG and WebP, one file per image. All bytes of the files count; alpha is not stored.

#include "tests/bench/rd/coded.hpp"

#include <string>
#include <vector>

namespace rs::bench {

enum class StillCodec {
    kJpeg,  // libjpeg(-turbo), 4:2:0, optimised Huffman tables
    kWebp,  // libwebp, lossy
};

/// \param shown opaque images to code, by view
/// \param quality 1..100
Result<Coded> code_stills(const ReferenceImages& images, const std::vector<Image<Rgba8>>& shown, StillCodec codec,
                          int quality);

}  // namespace rs::bench
