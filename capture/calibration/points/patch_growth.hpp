#pragma once
// Adds points beyond those that the detector finds: the neighbours on the surface of a patch that can be tracked around
// the turn can mostly be tracked, too. Runs before patch_alignment, which rejects those that are not visible.
//
// Based on the expansion of patches in Furukawa and Ponce, "Accurate, dense, and robust multiview stereopsis" (2010).

#include "capture/calibration/points/bundle.hpp"

namespace rs::capture {

/// Appends for each track of the bundle candidates one step to the left and right of it, above and below, in the view
/// in the middle of its arc (reference_observation): at the same depth in that view, and with observations predicted by
/// the model in the same views. Skips positions that already have a point or are outside the image. If the bundle would
/// exceed `most` tracks, an evenly spaced selection of the candidates is added. `reduction` as in patch_alignment.hpp.
void grow_patches(Bundle& bundle, int reduction, int most);

}  // namespace rs::capture
