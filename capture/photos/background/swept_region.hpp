#pragma once
// Which part of the still picture lies within the region that the object sweeps on its turn.
//
// A pixel that never changes shows the backdrop, or a part of the object that looks the same from all sides: the white
// ground of a painted vase, the flank of a white animal near the axis. Motion cannot tell them apart at a single pixel,
// but such parts of an object are surrounded by what moves and by an edge. So the region is the cheapest one that holds
// all moving pixels and stays away from the picture's border: a contour costs by its length, much where it runs
// through even ground, little along edges of the still picture, and least where motion ends.

#include "rayspace/image/image.hpp"

#include <optional>

namespace rs::capture {

struct SweptRegion {
    Image<std::uint8_t> mask;       // 255 within the region
    std::optional<double> axis_px;  // the axis' column, between what moves in the upper half; none where nothing does
};

// `still` is the still picture; `moves` is not 0 where the samples disagree over time. Both have one size. Costs a
// minimum cut over a grid of at most 256 cells a side, whatever the pictures' size; region and axis have the precision
// of such a cell.
SweptRegion swept_region(ConstImageView<Rgba8> still, ConstImageView<std::uint8_t> moves);

}  // namespace rs::capture
