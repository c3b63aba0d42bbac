#pragma once
/// \file
/// Fourth stage of an import: estimates lens, axis and angles of a turn from its foreground images. Takes the most
/// reliable calibration method that succeeds (photo_calibration.hpp), otherwise a nominal rig (nominal_rig.hpp). Runs
/// between segment_turn() and write_import_set().

#include "capture/calibration/known/known_files.hpp"
#include "capture/photos/rig/nominal_rig.hpp"
#include "capture/photos/rig/photo_calibration.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rs::capture {

/// Known values of the user. Calibration keeps them fixed, except for the axis column, which only a nominal rig uses.
struct RigRequest : NominalTurnRequest {
    CalibrationChoice calibration = CalibrationChoice::kAuto;
    KnownFile known;                   ///< kept fixed by calibration, like the fields of the base
    std::optional<BoardDesign> board;  ///< calibration board on the turntable, if any
};

/// Rig of a turn, calibrated or nominal.
struct FoundRig {
    NominalTurn nominal;
    PhotoCalibration calibration;
    CalibrationMethod method = CalibrationMethod::kNominal;
    double step_deg = 0;  ///< between neighbouring views, positive
    Turning turning = Turning::kClockwise;
    std::vector<std::string> left_out;  ///< names of photos taken at the angle of another photo
    std::vector<std::string> notes;     ///< warnings and remarks for the user, one line each
};

/// Calibrates the turn, or makes a nominal rig. `foregrounds` and `turn` are the results of segment_turn() for
/// `folder`. Pixel values of `given` refer to the photos as displayed (shown_width x shown_height), those of the result
/// to the images of the folder in working size (width x height). Errors: those of known_inputs_of() and
/// calibrate_photos().
Result<FoundRig> find_rig(const RigRequest& given, const PhotoFolder& folder, const SegmentedTurn& turn,
                          const ForegroundCache& foregrounds, Progress* progress);

}  // namespace rs::capture
