#pragma once
// The rig of an imported set, with where its numbers come from.

#include "capture/photos/report/import_report.hpp"
#include "rayspace/geometry/rig.hpp"

namespace rs::capture {

// Equal steps, a level camera: the pictures stay as they are. `visible` is in px of the photographs.
Rig nominal_import_rig(const ImportReport& report, const TurnSilhouette::Box& visible);

// As calibrated; `visible` is in px of the rectified pictures. Views whose photographs are left out are not there.
Rig calibrated_import_rig(const ImportReport& report, const TurnSilhouette::Box& visible);

}  // namespace rs::capture
