#pragma once
// Encodes a capture set's images for a given quality, fidelity or size.

#include "encode/codec/board/board_encoder.hpp"
#include "encode/codec/dense_encoder.hpp"
#include "encode/set/capture_set.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <optional>

namespace rs::encode {

/// Encoding goal: the first of bytes, fidelity and quality that is set.
struct ImageGoal {
    codec::Profile profile = codec::Profile::kDense;
    std::optional<std::uint64_t> images_bytes;  // upper limit of chunks CODE and PICT together
    std::optional<double> psnr_db;              // lower limit of EncodedImages::psnr_db
    double quality = 75;                        // kMinQuality .. kMaxQuality
    int effort = kDefaultEffort;                // dense encoder only: kMinEffort .. kMaxEffort
};
inline constexpr double kMinQuality = 1;
inline constexpr double kMaxQuality = 100;

/// The quantiser step of a quality: 2 at quality 100, doubled for every 14 less. BoardSettings::step defines its
/// meaning for board objects.
double quantiser_step_of_quality(double quality);

/// Encodes the images of `set`. A goal of fidelity or size takes up to about six encodings. Fails if an image cannot be
/// read or the goal cannot be reached. Memory: about 10 bytes per sample, and twice the bytes of the result per sample.
/// \param object      built from `set`; supplies views, rings and size.
/// \param alpha_bits  nullopt: chosen from the images, the profile, the step and the requested fidelity.
Result<EncodedImages> encode_images(const CaptureSet& set, const RaySpaceObject& object, const ImageGoal& goal,
                                    std::optional<int> alpha_bits, Progress* progress = nullptr);

/// The size of chunks CODE and PICT in the file.
std::uint64_t count_coded_bytes(const codec::CodedImages& coded);

}  // namespace rs::encode
