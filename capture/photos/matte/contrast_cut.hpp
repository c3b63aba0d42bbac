#pragma once
// Decides undecided pixels so that borders run where the contrast is: the minimum cut of a grid graph, after Boykov and
// Jolly, "Interactive graph cuts for optimal boundary and region segmentation of objects in N-D images" (ICCV 2001).

#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

struct CutOptions {
    float smoothness = 6;           // what it costs to part two neighbours of one colour
    float contrast_delta_e = 3.5F;  // parting gets cheap where neighbours differ by more than this
    float floor = 0.05F;            // what it costs at the very least: short borders are better than long ones
    int coarse_from_px = 400000;    // so many undecided pixels, 2 at least, and cut_coarse_first() goes coarse first
};

// 255 where the object is. `looks`: of the photograph. `preference` as in object_mask.hpp: pixels at +-kDecided keep
// their side, the rest is cut over the 8-neighbourhood. Memory and time go with the number of undecided pixels, not
// with the size of the picture.
Image<std::uint8_t> cut_by_contrast(ConstImageView<Lab> looks, ConstImageView<float> preference,
                                    const CutOptions& options);

// The same; where much is undecided nearly the same in a fraction of the time, which grows faster than the picture: one
// of half the size is cut first, itself so where that helps, and only what lies within kCoarseBand_px of its border, or
// prefers the other side clearly, is cut anew.
inline constexpr int kCoarseBand_px = 6;
Image<std::uint8_t> cut_coarse_first(ConstImageView<Lab> looks, ConstImageView<float> preference,
                                     const CutOptions& options);

}  // namespace rs::capture
