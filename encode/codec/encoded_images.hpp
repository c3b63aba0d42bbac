#pragma once
// What an encoder of images gives.

#include "rayspace/codec/code/coded_images.hpp"

namespace rs::encode {

struct EncodedImages {
    codec::CodedImages coded;
    double psnr_db = 0;  // R, G, B of all samples whose alpha is 128 or more, against the sources
};

}  // namespace rs::encode
