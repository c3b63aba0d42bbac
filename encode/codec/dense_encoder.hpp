#pragma once
// Encoder of the `dense` profile. The images of a ring are coded level by level, each predicted from its nearest coded
// neighbours on the ring. Every tile chooses its modes by rate and distortion; the probabilities are measured on the
// whole object.

#include "encode/codec/encoder_images.hpp"
#include "encode/codec/search_effort.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/codec/code/coded_images.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <array>
#include <functional>
#include <vector>

namespace rs::encode {

struct DenseSettings {
    double step = 12;  // quantiser step in units of an orthonormal coefficient of Y; 1 .. 200
    int alpha_bits = 2;
    int tile_width_log2 = 6;
    int tile_height_log2 = 6;
    int effort = kDefaultEffort;                      // kMinEffort .. kMaxEffort
    std::array<int, 4> level_offset = {-3, 0, 1, 2};  // added to the step index, by progressive level
    float lambda_factor = 0.12F;
    std::array<int, 2> chroma_offset = {0, 1};
};

/// The number of alpha bits worth their cost at a step: one bit, which the decoder smooths, from a step of 20 on. Two
/// bits if 31 dB or more are requested (`wanted_db`; 0: no fidelity is requested), however coarse the step, since the
/// loss of one bit at the edges exceeds all other loss there.
constexpr int dense_alpha_bits(double step, double wanted_db) {
    return step >= 20 && wanted_db < 31 ? 1 : 2;
}

/// Encodes the images of an object, which supplies rings and sizes. The result does not depend on the number of
/// threads. Memory: 4 bytes per sample of the coded size of the largest ring, and two bytes per coded decision.
/// \param sources  one per view, with settings.alpha_bits.
EncodedImages encode_dense(const RaySpaceObject& object, const std::vector<SourceImage>& sources,
                           const DenseSettings& settings, Progress* progress = nullptr);

/// Encodes RGBA images. `image(view)` is called once per view, from several threads.
codec::CodedImages encode_dense(const RaySpaceObject& object, const std::function<Image<Rgba8>(int)>& image,
                                const DenseSettings& settings, Progress* progress = nullptr);

}  // namespace rs::encode
