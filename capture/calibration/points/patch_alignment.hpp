#pragma once
// Observations made exact: the patch around a point as one view shows it is found again in every other view that may
// see the point, to a few hundredths of a pixel. Stands between a first bundle, which gives where to look, and the last
// one.
//
// A feature detector places each observation by itself, so a track is as noisy as the detector, and it ends where the
// detector fails. Alignment to one reference (Lucas and Kanade 1981, with affine warp, gain and bias) has neither
// fault.

#include "capture/calibration/points/bundle.hpp"
#include "capture/calibration/points/tracks.hpp"

#include <span>
#include <vector>

namespace rs::capture {

// What an observation by a detector counts beside aligned ones.
inline constexpr double kDetectedWeight = 0.3;

// Of a track, the observation nearest to the middle of the arc it is seen from: its reference.
const Observation& middle_of_arc(const TurntableModel& model, const Track& track);

// The tracks of the bundle's points, in their order, their reference observation unchanged and the others found by
// alignment. Of points that are not found in three views the first `known` keep their own observations, with
// kDetectedWeight; others are left out. Positions in px of the photographs, `turn` reduced by `reduction`. Works side
// by side; the result does not depend on the number of threads.
std::vector<Track> aligned_tracks(std::span<const CalibrationImage> turn, int reduction, const Bundle& bundle,
                                  std::size_t known);

}  // namespace rs::capture
