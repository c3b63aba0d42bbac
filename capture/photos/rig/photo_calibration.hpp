#pragma once
// Calibration of cut-out photographs by the surest means that works: a board, points of the object, silhouettes; where
// none does, nothing, and the rig stays nominal (nominal_rig.hpp). Stands between segment_turn and rectification.

#include "capture/calibration/board/board_calibration.hpp"
#include "capture/calibration/board/charuco_board.hpp"
#include "capture/calibration/model/calibration.hpp"
#include "capture/calibration/tracks/track_calibration.hpp"
#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/segmentation/segment_turn.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rs::capture {

// kAuto begins with the board where one is described and goes down the list; any other takes that one or fails.
enum class CalibrationChoice { kAuto, kBoard, kTracks, kSilhouettes, kNominal };

// Photographs are looked at with their longer side reduced to at most this, by a whole factor.
inline constexpr int kCalibrationSide_px = 1800;

struct PhotoCalibration {
    std::optional<Calibration> calibration;  // nothing: nominal
    std::optional<TrackCalibration> tracks;  // where points were followed to the end
    std::optional<BoardCalibration> board;   // where a board was found
    std::vector<std::string> notes;          // what did not work and why, one line each
};

struct CalibrationRequest {
    CalibrationChoice choice = CalibrationChoice::kAuto;
    KnownInputs known;
    std::optional<BoardDesign> board;
    // What is assumed where nothing is found: the start for silhouettes. Called where that is needed, for to find the
    // sense of turning takes its time.
    std::function<TurntableModel()> nominal;
};

// `cuts` are segment_turn()'s pictures of `folder`. Fails where a picture cannot be read, and where the choice was
// not kAuto and does not work.
Result<PhotoCalibration> calibrate_photos(const PhotoFolder& folder, const CutoutCache& cuts,
                                          const CalibrationRequest& request, Progress* progress);

}  // namespace rs::capture
