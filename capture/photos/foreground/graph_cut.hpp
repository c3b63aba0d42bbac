#pragma once
/// \file
/// Binary segmentation by minimum cut: labels the undecided pixels so that the contour runs where the contrast is.
///
/// Input: foreground scores (foreground_mask.hpp). Source: Boykov and Jolly, "Interactive graph cuts for optimal
/// boundary and region segmentation of objects in N-D images" (ICCV 2001).

#include "capture/photos/foreground/foreground_parameters.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

/// Minimizes the scores of the pixels labelled against them plus the costs of label changes over the 8-neighbourhood.
/// Pixels of score +-kCertainScore keep their label. Memory and time grow with the number of undecided pixels, not with
/// the image.
/// \param lab photo, \param score foreground scores of the same size, -kCertainScore..kCertainScore
/// \return 255 = object, 0 = background
Image<std::uint8_t> graph_cut(ConstImageView<Lab> lab, ConstImageView<float> score,
                              const ForegroundParameters::GraphCut& parameters);

/// Approximates graph_cut() in a fraction of its time, which grows faster than linearly: from
/// GraphCut::coarse_min_px undecided pixels on, cuts the image of half the size first, recursively, and then only the
/// band around its contour, and pixels whose score clearly contradicts it, in full resolution.
Image<std::uint8_t> graph_cut_coarse_to_fine(ConstImageView<Lab> lab, ConstImageView<float> score,
                                             const ForegroundParameters::GraphCut& parameters);

}  // namespace rs::capture
