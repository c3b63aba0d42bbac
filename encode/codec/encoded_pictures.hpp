#pragma once
// What an encoder of pictures gives.

#include "rayspace/codec/code/coded_pictures.hpp"

namespace rs::encode {

struct EncodedPictures {
    codec::CodedPictures coded;
    double psnr_db = 0;  // R, G, B of all samples whose alpha is 128 or more, against the sources
};

}  // namespace rs::encode
