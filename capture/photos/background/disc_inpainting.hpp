#pragma once
/// \file
/// Inpainting of the clean plate on a turntable disc: what the object covers looks like the rest of the same circle.
///
/// Follows find_turntable_disc() in clean_plate_of_turn() and estimate_background(). Masks hold 255 or 0, and not 0
/// where they are arguments.

#include "capture/photos/background/background_parameters.hpp"
#include "capture/photos/background/turntable_disc.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <optional>

namespace rs::capture {

/// Mask of width x height px: the disc, its blurred rim, and its surroundings up to `reach` (>= 0) of its radius.
Image<std::uint8_t> disc_mask(const TurntableDisc& disc, int width, int height, double reach,
                              const BackgroundParameters::Disc& parameters);

/// Mask of a static foot of the object on the disc, outside of `swept` (where motion shows the object): pixels of
/// circles that the object mostly covers, which the colour of the bare disc does not explain, shaded or not, and which
/// are connected to `swept`. `colour`: BackgroundEstimate::colour; `known`: where the plate is known. All have one
/// size.
Image<std::uint8_t> static_foot(const TurntableDisc& disc, ConstImageView<Rgba8> colour,
                                ConstImageView<std::uint8_t> known, ConstImageView<std::uint8_t> swept,
                                const BackgroundParameters& parameters);

/// Inpaints gaps of the plate on the disc by interpolation along its circles, and the rest by inpaint_rows(), as if the
/// disc were not there. Sets `known` to 255 where it does. Without a disc: inpaint_rows().
void inpaint_gaps(const std::optional<TurntableDisc>& disc, Image<Rgba8>& plate, Image<std::uint8_t>& known,
                  const BackgroundParameters& parameters);

}  // namespace rs::capture
