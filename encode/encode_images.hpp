#pragma once
// From a capture set's images to coded images of a wanted quality, fidelity or size.

#include "encode/codec/board/board_encoder.hpp"
#include "encode/codec/dense_encoder.hpp"
#include "encode/set/capture_set.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <optional>

namespace rs::encode {

// Of bytes, fidelity and quality one is followed, the first that is given.
struct ImageGoal {
    codec::Profile profile = codec::Profile::kDense;
    std::optional<std::uint64_t> images_bytes;  // at most: chunks CODE and PICT together
    std::optional<double> psnr_db;              // at least, of EncodedImages::psnr_db
    double quality = 75;                        // kMinQuality .. kMaxQuality
    int effort = kUsualEffort;                  // of the dense encoder: kLeastEffort .. kMostEffort
};
inline constexpr double kMinQuality = 1;
inline constexpr double kMaxQuality = 100;

// 100: a step of 2; twice that for every 14 less. What it means to a board object: board_encoder.hpp.
double step_of_quality(double quality);

// Encodes the images of `set`, of which `object` (views, rings, size) was built; alpha in `alpha_bits` bits, or in as
// many as suit the images, the profile, the step and the requested fidelity. For a goal of fidelity or size it
// encodes up to some six times. Fails where an image cannot be read, or the goal cannot be reached. Memory: some 10
// bytes a sample, and twice the bytes of the result per sample.
Result<EncodedImages> encode_images(const CaptureSet& set, const RaySpaceObject& object, const ImageGoal& goal,
                                    std::optional<int> alpha_bits, Progress* progress = nullptr);

// Of chunks CODE and PICT, as the file will have them.
std::uint64_t coded_bytes(const codec::CodedImages& coded);

}  // namespace rs::encode
