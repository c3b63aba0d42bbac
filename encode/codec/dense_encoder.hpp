#pragma once
// The encoder of the `dense` profile: images of a ring are coded level by level, each predicted from its nearest
// coded neighbours on the ring; every tile chooses by rate and distortion, and the probabilities are those of the
// object.

#include "encode/codec/encoded_images.hpp"
#include "encode/codec/search_effort.hpp"
#include "encode/codec/source_image.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/codec/code/coded_images.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <array>
#include <functional>
#include <vector>

namespace rs::encode {

struct DenseSettings {
    double step = 12;  // of the quantiser, in units of an orthonormal coefficient of Y; 1 .. 200
    int alpha_bits = 2;
    int tile_width_log2 = 6;
    int tile_height_log2 = 6;
    int effort = kUsualEffort;                        // kLeastEffort .. kMostEffort
    std::array<int, 4> level_offset = {-3, 0, 1, 2};  // of the step index, by progressive level
    float lambda_factor = 0.12F;
    std::array<int, 2> chroma_offset = {0, 1};
};

// The alpha bits that are worth their cost at a step: one, of which the decoder makes soft edges, from a step of 20 on.
// Not where images of 31 dB and more are requested (wanted_db; 0: no fidelity is), however coarse the step that
// reaches them: what one bit costs at the edges is more than all else together.
constexpr int dense_alpha_bits(double step, double wanted_db) {
    return step >= 20 && wanted_db < 31 ? 1 : 2;
}

// `sources`: one per view, of settings.alpha_bits. The object gives rings and sizes. The same input gives the same
// bytes on any number of threads. Memory: 4 bytes a sample of the coded size, and some two bytes for each bit of the
// result.
EncodedImages encode_dense(const RaySpaceObject& object, const std::vector<SourceImage>& sources,
                           const DenseSettings& settings, Progress* progress = nullptr);

// The same of RGBA images; `image(view)` is called once per view, from several threads.
codec::CodedImages encode_dense(const RaySpaceObject& object, const std::function<Image<Rgba8>(int)>& image,
                                const DenseSettings& settings, Progress* progress = nullptr);

}  // namespace rs::encode
