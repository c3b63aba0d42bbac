#pragma once
// The fourth stage of an import: lens, axis and angles of a turn whose photographs are cut out, calibrated by the
// surest means that works (photo_calibration.hpp), else nominal (nominal_rig.hpp). Stands between segment_turn and
// import_set.

#include "capture/calibration/known/known_files.hpp"
#include "capture/photos/rig/nominal_rig.hpp"
#include "capture/photos/rig/photo_calibration.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rs::capture {

// Calibration holds what is given here but the axis' column, which is for a nominal rig.
struct RigRequest : NominalTurnRequest {
    CalibrationChoice calibration = CalibrationChoice::kAuto;
    KnownFile known;                   // held by calibration, with the above
    std::optional<BoardDesign> board;  // of the board that lies on the turntable
};

struct FoundRig {
    NominalTurn nominal;
    PhotoCalibration calibration;
    CalibrationMethod method = CalibrationMethod::kNominal;
    double step_deg = 0;
    Turning turning = Turning::kClockwise;
    std::vector<std::string> left_out;  // names of photographs that stand where another one does
    std::vector<std::string> notes;     // one line each: what the user should know
};

// `cuts` and `turn` are segment_turn()'s of `folder`. What is `given` in px is of the photographs as they are shown,
// what is found of the folder's pictures. Errors: those of known_of_photographs() and calibrate_photos().
Result<FoundRig> find_rig(const RigRequest& given, const PhotoFolder& folder, const SegmentedTurn& turn,
                          const CutoutCache& cuts, Progress* progress);

}  // namespace rs::capture
