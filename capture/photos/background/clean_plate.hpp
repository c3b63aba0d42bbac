#pragma once
/// \file
/// Clean plate of a turn: the static background, also where the object covers it in some frames.
///
/// Stages: the region that the object sweeps (swept_region()) leaves the always visible pixels; the plate grows from
/// them inwards (plate_propagation.hpp); gaps are inpainted along rows, or along circles of a turntable disc
/// (disc_inpainting.hpp), and where frames confirm the guess the plate grows from there, too. Static pixels of the
/// region that the plate does not explain belong to the object.

#include "capture/photos/background/background_estimate.hpp"
#include "capture/photos/background/background_parameters.hpp"
#include "capture/photos/background/exposure_normalized_frames.hpp"
#include "capture/photos/background/turntable_disc.hpp"
#include "rayspace/image/image.hpp"

#include <optional>

namespace rs::capture {

/// All images have the frames' size; masks hold 255 or 0.
struct CleanPlate {
    Image<Rgba8> colour;                 ///< sRGB; defined where `known`
    Image<std::uint8_t> known;           ///< some frames show the background
    Image<std::uint8_t> always_visible;  ///< the object never covers the background
    Image<std::uint8_t> always_covered;  ///< static part of the object, in front of the background in all frames
    std::optional<TurntableDisc> disc;   ///< nullopt: none was detected
};

/// `background`: temporal_consensus() of the frames; `static_pixels`: not 0 where the frames agree, be it on the
/// background or on the object. At most 64 frames.
CleanPlate clean_plate_of_turn(const ExposureNormalizedFrames& frames, const BackgroundEstimate& background,
                               ConstImageView<std::uint8_t> static_pixels, const BackgroundParameters& parameters);

/// Mean delta E between the plate and those frames that show it, averaged over a neighbourhood. Measured only where
/// `known` is not 0; elsewhere extended from the neighbourhood, or 0.
Image<float> plate_noise(const ExposureNormalizedFrames& frames, const Image<Rgba8>& plate,
                         const Image<std::uint8_t>& known, const BackgroundParameters& parameters);

/// First stage of the clean plate: the region of the image that the object sweeps over the turn, by a minimum cut.
///
/// A pixel that never changes shows the background, or a part of the object that looks the same from all sides: the
/// white ground of a painted vase, the flank of a white animal near the axis. A single pixel cannot be classified, but
/// such parts are surrounded by motion and by an edge. The region is therefore the cheapest one that contains all
/// moving pixels and stays away from the image border; its contour is expensive through uniform surfaces, cheap along
/// edges of the background estimate and cheapest where motion ends (graph cut after Boykov and Jolly, 2001). Surfaces
/// of revolution about the axis, static bands and a foot are then added.
///
/// Mask, 255 = swept, of the size of both arguments. `colour`: BackgroundEstimate::colour; `moves`: not 0 where the
/// frames disagree. The precision is a cell of the grid, of at most SweptRegion::max_grid_cells per side, which bounds
/// the cost.
Image<std::uint8_t> swept_region(ConstImageView<Rgba8> colour, ConstImageView<std::uint8_t> moves,
                                 const BackgroundParameters::SweptRegion& parameters);

}  // namespace rs::capture
