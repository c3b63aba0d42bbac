#pragma once
// Refines observations by patch alignment: the patch around a point in one view is aligned to every other view that may
// see the point, to a few hundredths of a pixel. Runs between a first bundle, which predicts the positions, and the
// last one.
//
// A feature detector localizes each observation independently, so a track is as noisy as the detector, and it ends
// where detection fails. Alignment to one reference (Lucas and Kanade 1981, with affine warp, gain and bias) avoids
// both.

#include "capture/calibration/points/bundle.hpp"
#include "capture/calibration/points/tracks.hpp"

#include <span>
#include <vector>

namespace rs::capture {

/// Weight of a detected observation relative to aligned ones.
inline constexpr double kDetectedWeight = 0.3;

/// The reference observation of a track: the one nearest to the middle of the arc it is seen from.
const Observation& reference_observation(const TurntableModel& model, const Track& track);

/// The tracks of the bundle's points, in their order, with the reference observation unchanged and the others from
/// alignment. If alignment succeeds in fewer than three views, the first `known` points keep their own observations,
/// with kDetectedWeight; others are left out. Positions in px of the photos, `turn` reduced by `reduction`. Runs in
/// parallel; the result does not depend on the number of threads.
std::vector<Track> align_tracks(std::span<const CalibrationImage> turn, int reduction, const Bundle& bundle,
                                std::size_t known);

/// Adds points beyond those that the detector finds: the neighbours on the surface of a patch that can be tracked
/// around the turn can mostly be tracked, too. Runs before align_tracks(), which rejects those that are not visible.
/// Based on the expansion of patches in Furukawa and Ponce, "Accurate, dense, and robust multiview stereopsis" (2010).
///
/// Appends for each track of the bundle candidates one step to the left and right of it, above and below, in the view
/// in the middle of its arc (reference_observation): at the same depth in that view, and with observations predicted by
/// the model in the same views. Skips positions that already have a point or are outside the image. If the bundle would
/// exceed `most` tracks, an evenly spaced selection of the candidates is added. `reduction` as in align_tracks().
void grow_patches(Bundle& bundle, int reduction, int most);

}  // namespace rs::capture
