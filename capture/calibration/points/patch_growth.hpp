#pragma once
// More points than a detector sees: beside a patch that can be followed around the turn, those next to it on the
// surface mostly can be, too. Stands before patch_alignment, which finds out which of them are there.
//
// After the expansion of patches in Furukawa and Ponce, "Accurate, dense, and robust multiview stereopsis" (2010).

#include "capture/calibration/points/bundle.hpp"

namespace rs::capture {

// Appends to the bundle, for each of its tracks, those one step to the left and right of it, above and below, as the
// view in the middle of its arc shows it (middle_of_arc): as far from the camera there, seen from the same views, where
// the model expects them. None where the bundle has a point already, nor beside the image; where the bundle would get
// more than `most` observations, evenly spread ones of them. `reduction` as in patch_alignment.hpp.
void grow(Bundle& bundle, int reduction, int most);

}  // namespace rs::capture
