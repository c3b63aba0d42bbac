#pragma once
/// \file
/// Growth of the clean plate from the always visible pixels into the region that the object sweeps.
///
/// A pixel of that region shows background and object in turn. The background's value is the one that continues its
/// neighbour: the background varies smoothly, and a frame that shows it at one pixel mostly shows it at the next. Every
/// plate pixel therefore has the set of frames that show the background there, its *support*; a neighbour joins the
/// plate if most of the support shows the same colour there. Where the object always covers the background the support
/// runs out and growth stops; the object's colour has no support, however many frames agree on it. Edges of the
/// background are not crossed. Stage of clean_plate_of_turn().

#include "capture/photos/background/background_parameters.hpp"
#include "capture/photos/background/exposure_normalized_frames.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>

namespace rs::capture {

struct PropagatedPlate {
    Image<Rgba8> colour;           ///< denoised; undefined where `support` is 0
    Image<std::uint64_t> support;  ///< [pixel] bit i: frame i shows the background; 0: not part of the plate
};

/// Selects whether growth follows the support alone or only to colours near the guess: seeds that are themselves
/// guesses must not lead away from it.
enum class Growth { kFree, kNearGuess };

/// Start and limits of the growth. All images have the frames' size.
struct PlateSeeds {
    ConstImageView<Rgba8> guess;
    ConstImageView<std::uint8_t> seeds;   ///< not 0: joins the plate if the frames show about the colour `guess`
    ConstImageView<std::uint8_t> barred;  ///< not 0: never joins the plate
    Growth growth = Growth::kFree;
};

/// Adds the seeds that the frames confirm to `plate`, which is empty or has the frames' size, and grows it from there.
/// At most 64 frames.
void propagate_plate(const ExposureNormalizedFrames& frames, const PlateSeeds& from,
                     const BackgroundParameters::Propagation& parameters, PropagatedPlate& plate);

/// Mean of the supporting frames without denoising, sRGB; black where there is no support.
Image<Rgba8> undenoised_colours(const ExposureNormalizedFrames& frames, const PropagatedPlate& plate);

/// 255 where `candidates` is not 0 and at least Propagation::min_support frames show a patch of the guessed `plate`
/// around the pixel; else 0. All have the frames' size. At most 64 frames.
Image<std::uint8_t> confirm_plate(const ExposureNormalizedFrames& frames, ConstImageView<Rgba8> plate,
                                  ConstImageView<std::uint8_t> candidates,
                                  const BackgroundParameters::Propagation& parameters);

}  // namespace rs::capture
