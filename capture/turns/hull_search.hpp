#pragma once
/// \file
/// Registration of a turn by its silhouettes: searches the placement, and if needed the camera's tilt, at which the
/// visual hull of turns that are already placed covers the turn's masks.

#include "capture/calibration/points/tracks.hpp"
#include "capture/posed/visual_hull.hpp"
#include "capture/turns/turn_placement.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>
#include <opencv2/core.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace rs::capture {

/// Reduced masks of a turn with holes filled: a hole may be a reflection of the background.
struct TurnMasks {
    std::vector<cv::Mat1b> masks;  ///< [view] 255: object
    double reduction = 1;          ///< px of the photos per px of the masks
};

/// The longer side of the masks is at most `side_px`.
TurnMasks turn_masks(const TurnImages& turn, int side_px);

/// Masks with the cameras of a placed turn, without lens distortion.
std::vector<HullView> hull_views(const PlacedTurn& turn, const TurnMasks& masks);

/// Points on the surface of the visual hull of the views, in the common frame. Error: the hull is empty.
Result<std::vector<glm::dvec3>> hull_surface(std::span<const HullView> views);

/// Mean over the views of intersection over union of a mask and the projected hull.
double silhouette_overlap(std::span<const glm::dvec3> surface, const PlacedTurn& turn, const TurnMasks& masks);

/// Indices of views whose mask is clearly smaller or larger than the hull of all views predicts, relative to the other
/// views.
struct DoubtfulMasks {
    std::vector<std::size_t> small, large;
};
DoubtfulMasks find_doubtful_masks(std::span<const HullView> views);

struct HullMatch {
    PlacedTurn turn;
    double overlap = 0;    ///< silhouette_overlap()
    double score = 0;      ///< overlap less the penalty of an unexpected distance
    double runner_up = 0;  ///< the largest score at an azimuth that differs by more than 20 degrees
};

struct HullSearch {
    std::span<const glm::dvec3> surface;
    const TurnMasks& masks;
    const TurntableModel& model;  ///< lens, angles, and pose unless is_tilt_free
    bool is_tilt_free = false;    ///< searches -10 to 85 degrees; pan is kept at the column of the axis
    /// Distance that is expected along the viewing direction, since cameras on an arm have one distance; 0: unknown.
    double expected_slant = 0;
};

/// Tries all azimuths (and tilts); distance and height follow from the size and position of the silhouettes.
HullMatch search_by_hull(const HullSearch& search);

}  // namespace rs::capture
