#pragma once
// JPEG and WebP: every image a file of its own. All bytes of the files count; alpha is not stored.

#include "tests/bench/rd/coded.hpp"

#include <string>
#include <vector>

namespace rs::bench {

enum class StillCodec {
    kJpeg,  // libjpeg(-turbo), 4:2:0, optimised Huffman tables
    kWebp,  // libwebp, lossy
};

// `shown` are the opaque images to code, view by view. quality 1..100.
Result<Coded> code_stills(const ReferenceImages& images, const std::vector<Image<Rgba8>>& shown, StillCodec codec,
                          int quality);

}  // namespace rs::bench
