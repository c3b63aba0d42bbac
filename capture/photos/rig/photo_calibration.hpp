#pragma once
/// \file
/// Calibration of a turn from its foreground images by the most reliable method that succeeds: a board, points of the
/// object, silhouettes. If none succeeds there is no calibration and the rig stays nominal (nominal_rig.hpp). Runs
/// between segment_turn() and rectification.

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

/// Calibration method. kAuto tries the board if one is described, then the following methods in order. Any other value
/// selects a single method, whose failure is an error.
enum class CalibrationChoice { kAuto, kBoard, kTracks, kSilhouettes, kNominal };

/// Maximum length of a photo's longer side during calibration. Larger photos are reduced by an integer factor.
inline constexpr int kCalibrationSide_px = 1800;

/// Result of calibrate_photos().
struct PhotoCalibration {
    std::optional<Calibration> calibration;  ///< nullopt: the rig stays nominal
    std::optional<TrackCalibration> tracks;  ///< set if point tracks calibrated the turn
    std::optional<BoardCalibration> board;   ///< set if a board calibrated the turn
    std::vector<std::string> notes;          ///< methods that failed and their reasons, one line each
};

/// Input of calibrate_photos(). Pixel values refer to the working size of the folder.
struct CalibrationRequest {
    CalibrationChoice choice = CalibrationChoice::kAuto;
    KnownInputs known;
    std::optional<BoardDesign> board;
    /// Returns the assumed model, the start of the calibration from silhouettes. Called only on demand, since the
    /// estimate of the direction of rotation is slow.
    std::function<TurntableModel()> nominal;
};

/// Reads the foreground images of a turn, reduced for calibration. Errors: an unreadable image.
Result<TurnImages> read_turn_images(const PhotoFolder& folder, const ForegroundCache& foregrounds, Progress* progress);

/// Calibrates the turn. `foregrounds` holds the foreground images of `folder` from segment_turn(). Errors: an
/// unreadable image, known angles for another number of photos, the failure of a method other than kAuto.
Result<PhotoCalibration> calibrate_photos(const PhotoFolder& folder, const ForegroundCache& foregrounds,
                                          const CalibrationRequest& request, Progress* progress);

}  // namespace rs::capture
