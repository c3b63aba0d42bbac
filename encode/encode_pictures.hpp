#pragma once
// From a capture set's pictures to coded pictures of a wanted quality, fidelity or size.

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
struct PictureGoal {
    codec::Profile profile = codec::Profile::kDense;
    std::optional<std::uint64_t> pictures_bytes;  // at most: chunks CODE and PICT together
    std::optional<double> psnr_db;                // at least, of EncodedPictures::psnr_db
    double quality = 75;                          // kMinQuality .. kMaxQuality
    int effort = kUsualEffort;                    // of the dense encoder: kLeastEffort .. kMostEffort
};
inline constexpr double kMinQuality = 1;
inline constexpr double kMaxQuality = 100;

// 100: a step of 2; twice that for every 14 less. What it means to a board object: board_encoder.hpp.
double step_of_quality(double quality);

// Encodes the pictures of `set`, of which `object` (views, rings, size) was built; alpha in `alpha_bits` bits, or in as
// many as suit the pictures, the profile, the step and the requested fidelity. For a goal of fidelity or size it
// encodes up to some six times. Fails where a picture cannot be read, or the goal cannot be reached. Memory: some 10
// bytes a sample, and twice the bytes of the result per sample.
Result<EncodedPictures> encode_pictures(const CaptureSet& set, const RaySpaceObject& object, const PictureGoal& goal,
                                        std::optional<int> alpha_bits, Progress* progress = nullptr);

// Of chunks CODE and PICT, as the file will have them.
std::uint64_t coded_bytes(const codec::CodedPictures& coded);

}  // namespace rs::encode
