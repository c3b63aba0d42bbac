#pragma once
// Calibration of a turn with the printed board on the turntable: the surest means. Corners (board_detection.hpp) -> the
// turntable's model and where the board lies.
//
// Unknown are f, k1, k2, the camera's pan, tilt and roll, one angle per view and the board's place; the principal point
// is the image's middle unless KnownInputs gives another. The board may lie anywhere on the turntable, turned and
// not quite level. A board that is seen from straight above or from the side does not determine the focal length: 15 to
// 70 degrees above are good.

#include "capture/calibration/board/board_detection.hpp"
#include "capture/calibration/model/calibration.hpp"

#include <span>
#include <string>

namespace rs::capture {

struct BoardCalibration {
    Calibration calibration;  // points: corners of the board that are seen at all
    // The board at angle 0: p_in_object = units_per_mm * object_from_board * p_in_board_mm + middle.
    glm::dmat3 object_from_board{1};
    glm::dvec3 middle{0};
    double units_per_mm = 0;
    double mm_per_unit = 0;  // a unit of the table frame is the camera's distance from the axis
    // The printed plane in the object frame at angle 0: dot(plane_normal, p) = plane_offset. The normal looks up.
    glm::dvec3 plane_normal{0, 1, 0};
    double plane_offset = 0;
    int outliers = 0;  // observations left out
};

// views[i] shows view i of a turn in images of width x height pixels. `names` (one per view, or none) are for
// messages alone. Every tenth observation takes no part and gives held_out_rms_px; observations more than five
// deviations off are left out of both. Errors: fewer than three views show the board; the angle of a view is told by
// nothing; given angles that contradict the board; no solution. Deterministic; thread-safe; 36 views take well below a
// second.
Result<BoardCalibration> calibrate_with_board(std::span<const BoardCorners> views, const BoardDesign& design, int width,
                                              int height, const KnownInputs& known,
                                              std::span<const std::string> names = {});

}  // namespace rs::capture
