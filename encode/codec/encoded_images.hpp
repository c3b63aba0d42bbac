#pragma once
// Result of an image encoder, and its fidelity.

#include "rayspace/codec/code/coded_images.hpp"

namespace rs::encode {

struct EncodedImages {
    codec::CodedImages coded;
    double psnr_db = 0;  // measure_coded_psnr() against the sources
};

}  // namespace rs::encode
