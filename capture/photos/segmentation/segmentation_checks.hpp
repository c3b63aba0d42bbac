#pragma once
/// \file
/// Signs that the foreground images of a turn are not usable: the background was kept, or parts of the object are
/// missing.

#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/segmentation/segment_turn.hpp"
#include "capture/photos/segmentation/segmenter_choice.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace rs::capture {

struct SegmentationFindings {
    std::vector<std::string> problems;  ///< the result is not usable; one line each, with the remedy
    std::vector<std::string> notes;     ///< hints for the user; one line each
};

/// Checks coverage, contact with the image border, and whether the silhouettes can be those of one rigid object.
SegmentationFindings check_segmentation(const PhotoFolder& folder, const SegmentedTurn& turn, SegmenterKind kind,
                                        const CheckParameters& parameters = {});

/// True if most of what reaches the image border in most of the foreground images (all of one size) never changes:
/// background that was kept. False for fewer than six foreground images.
bool is_static_at_border(std::span<const Image<Rgba8>> foregrounds);

/// Photos whose silhouette area, `coverage` in order of a full turn, deviates from the mean of its neighbours by more
/// than a rotating flat plate's could: by sin(step) of the largest area, with a margin.
std::vector<std::size_t> contradicting_silhouettes(std::span<const double> coverage,
                                                   const CheckParameters& parameters = {});

}  // namespace rs::capture
