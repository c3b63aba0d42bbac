#pragma once
/// \file
/// Region of the image that the object sweeps over the turn, by a minimum cut.
///
/// A pixel that never changes shows the background, or a part of the object that looks the same from all sides: the
/// white ground of a painted vase, the flank of a white animal near the axis. A single pixel cannot be classified, but
/// such parts are surrounded by motion and by an edge. The region is therefore the cheapest one that contains all
/// moving pixels and stays away from the image border; its contour is expensive through uniform surfaces, cheap along
/// edges of the background estimate and cheapest where motion ends (graph cut after Boykov and Jolly, 2001). Surfaces
/// of revolution about the axis, static bands and a foot are then added. First stage of the clean plate.

#include "capture/photos/background/background_parameters.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

/// Mask, 255 = swept, of the size of both arguments. `colour`: BackgroundEstimate::colour; `moves`: not 0 where the
/// frames disagree. The precision is a cell of the grid, of at most SweptRegion::max_grid_cells per side, which bounds
/// the cost.
Image<std::uint8_t> swept_region(ConstImageView<Rgba8> colour, ConstImageView<std::uint8_t> moves,
                                 const BackgroundParameters::SweptRegion& parameters);

}  // namespace rs::capture
