#pragma once
// The encoder of the `board` profile: one image in nine is a reference, made of flat blocks plus entries of
// codebooks; blocks of the others are predicted from the references next to them on the ring. Codebooks are trained on
// the object; every block chooses its class of record by rate and distortion.

#include "encode/codec/encoded_images.hpp"
#include "encode/codec/source_image.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <vector>

namespace rs::encode {

struct BoardSettings {
    double step = 12;  // fidelity: what an error is worth beside a byte; 1 .. 200, as a quantiser's step
    int alpha_bits = 2;
    int views_per_reference = 9;
    double lambda_factor = 0.12;
};

// As encode_dense(). Memory: 8 bytes a sample of the coded size, and some 30 MB.
EncodedImages encode_board(const RaySpaceObject& object, const std::vector<SourceImage>& sources,
                           const BoardSettings& settings, Progress* progress = nullptr);

}  // namespace rs::encode
