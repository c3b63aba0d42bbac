#pragma once
// Estimates shift and scale of images that were moved and scaled individually (ImagePlacement): no turn in front
// of a fixed camera explains them until this is undone. Runs between point tracking and track_calibration.

#include "capture/calibration/model/calibration.hpp"
#include "capture/calibration/model/turntable_model.hpp"
#include "capture/calibration/points/bundle.hpp"
#include "capture/calibration/points/tracks.hpp"

#include <optional>
#include <span>
#include <vector>

namespace rs::capture {

struct PlacementEstimate {
    std::vector<ImagePlacement> places;  // [view]
    TurntableModel model;                // of the images with their placements undone, with equal steps
    double agreeing = 0;                 // share of the observations within a few pixels of the model
};

/// `tracks` in px of the photos; `lens` gives the frame and its centre. Several focal lengths, tilts and both
/// directions of turning are tried. Ambiguities between shifts or scales and another position of the axis or the camera
/// are resolved by a prior towards the smallest shifts and scales. Nothing if no adjustment succeeds. Uses all cores.
std::optional<PlacementEstimate> estimate_placements(std::span<const Track> tracks, const Lens& lens, std::size_t views,
                                                     int reduction, const KnownInputs& known);

/// Estimates the remaining error of the placements from `bundle`, whose images have them undone: result[view], to be
/// composed with the current ones as the inner placement. `limit_px`: inlier limit of the observations. Nothing if the
/// adjustment fails.
std::optional<std::vector<ImagePlacement>> estimate_remaining_placements(const Bundle& bundle, double limit_px,
                                                                         const KnownInputs& known);

/// Warps the images to those of a fixed camera; pixels that an image does not cover are transparent.
TurnImages undo_placements(const TurnImages& turn, std::span<const ImagePlacement> places);

}  // namespace rs::capture
