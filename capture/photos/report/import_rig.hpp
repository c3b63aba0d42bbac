#pragma once
/// \file
/// Rig of an imported capture set, with the provenance of its numbers.

#include "capture/photos/report/import_report.hpp"
#include "rayspace/geometry/rig.hpp"

namespace rs::capture {

/// Makes the nominal rig: equal steps, a level camera, images that are not resampled. `visible` is in px of the photos
/// in working size.
Rig nominal_import_rig(const ImportReport& report, const TurnSilhouette::Box& visible);

/// Makes the calibrated rig, without the views of photos that are left out. `visible` is in px of the rectified images.
Rig calibrated_import_rig(const ImportReport& report, const TurnSilhouette::Box& visible);

}  // namespace rs::capture
