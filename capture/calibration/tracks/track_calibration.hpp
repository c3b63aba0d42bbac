#pragma once
// Calibration of a turn from points of the object: start search, bundle, outliers, hold-out, judgement. The outlines of
// a full turn have their say in where the axis is (silhouette_symmetry.hpp). Where no turn before a still camera
// explains the points, images are taken to have been moved and scaled one by one, as shops do, and put back
// (image_places.hpp). Where the points are explained best by a lens that folds its own image over, all is done
// again without distortion.

#include "capture/calibration/model/calibration.hpp"
#include "capture/calibration/points/bundle.hpp"
#include "capture/calibration/points/tracks.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

namespace rs::capture {

struct TrackCalibration {
    Calibration calibration;
    FollowedPoints followed;  // positions in px of the photographs, put back to their places
    Bundle bundle;            // the tracks that took part, at the optimum but for the axis' position
};

// Fails, with what a photographer can do about it, where the images do not determine a single-axis motion: too few
// points, neighbours that share too little, points that do not agree (two cameras, a moved tripod), angles that make no
// turn. One thread calls; works on all cores.
Result<TrackCalibration> calibrate_with_tracks(const TurnImages& turn, const KnownInputs& known, Progress* progress);

}  // namespace rs::capture
