#pragma once
// Tile encoder: chooses the modes of each unit by weighted squared error and bits, and reconstructs it as the decoder
// does.

#include "encode/codec/coders.hpp"
#include "encode/codec/encoder_images.hpp"
#include "encode/codec/search_effort.hpp"
#include "rayspace/codec/code/dense_code.hpp"
#include "rayspace/codec/dense_tile.hpp"

#include <array>
#include <vector>

namespace rs::encode {

struct ImageTask {
    const codec::DenseCode* code = nullptr;
    codec::ImageHead head;
    const SourceImage* source = nullptr;
    std::array<codec::ConstPlaneViews, 2> references;
    std::array<int, 2> reach = {0, 0};  // range of the motion search per reference, samples
    float lambda = 0;
    UnitEffort effort;
    codec::PlaneViews out;  // the reconstruction
};

/// Encodes the tile at `place`, which must have a valid sample. Appends its decisions, and the vectors used per
/// reference to `motions`.
void encode_tile(const ImageTask& task, const CostTable& costs, const codec::TileRect& place,
                 std::vector<Decision>& decisions, std::array<std::vector<codec::MotionVector>, 2>& motions);

}  // namespace rs::encode
