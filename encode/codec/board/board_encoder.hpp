#pragma once
// Encoder of the `board` profile. One image in nine is a reference, made of flat blocks plus codebook entries; blocks
// of the others are predicted from the adjacent references on the ring. Codebooks are trained on the object; every
// block chooses its record class by rate and distortion.

#include "encode/codec/encoder_images.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <vector>

namespace rs::encode {

struct BoardSettings {
    double step = 12;  // trade-off of errors against bytes, 1 .. 200, comparable to a quantiser step
    int alpha_bits = 2;
    int views_per_reference = 9;
    double lambda_factor = 0.12;
};

/// As encode_dense(). Memory: 8 bytes per sample of the coded size, and about 30 MB.
EncodedImages encode_board(const RaySpaceObject& object, const std::vector<SourceImage>& sources,
                           const BoardSettings& settings, Progress* progress = nullptr);

}  // namespace rs::encode
