#pragma once
// Calibrates a turn with the printed board on the turntable, the most accurate method: corners (board_detection.hpp) ->
// turntable model and placement of the board.
//
// The unknowns are f, k1, k2, the camera's pan, tilt and roll, one angle per view and the placement of the board; the
// principal point is the image centre unless KnownInputs gives another. The board may lie anywhere on the turntable,
// rotated and not quite level. A board seen from straight above or from the side does not determine the focal length;
// elevations of 15 to 70 degrees are good.

#include "capture/calibration/board/board_detection.hpp"
#include "capture/calibration/model/calibration.hpp"

#include <span>
#include <string>

namespace rs::capture {

struct BoardCalibration {
    Calibration calibration;  // points: board corners that are seen in at least one view
    /// The board at angle 0: p_in_object = units_per_mm * object_from_board * p_in_board_mm + middle.
    glm::dmat3 object_from_board{1};
    glm::dvec3 middle{0};
    double units_per_mm = 0;
    double mm_per_unit = 0;  // a unit of the table frame is the camera's distance from the axis
    /// The printed plane in the object frame at angle 0: dot(plane_normal, p) = plane_offset. The normal points up.
    glm::dvec3 plane_normal{0, 1, 0};
    double plane_offset = 0;
    int outliers = 0;  // rejected observations
};

/// views[i] holds the corners of view i of a turn, in images of width x height pixels. `names` (one per view, or none)
/// are used in messages only. Every tenth observation is held out and gives held_out_rms_px; observations with
/// residuals above five standard deviations are rejected from both sets. Errors: fewer than three views show the board;
/// the angle of a view is undetermined; given angles contradict the board; no solution. Deterministic; thread-safe; 36
/// views take well below a second.
Result<BoardCalibration> calibrate_with_board(std::span<const BoardCorners> views, const BoardDesign& design, int width,
                                              int height, const KnownInputs& known,
                                              std::span<const std::string> names = {});

}  // namespace rs::capture
