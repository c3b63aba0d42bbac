#pragma once
// First values for calibrating with a board, from the corners alone. Stands between detection and the bundle.
//
// Each view's homography from the board's plane to the image gives the camera's pose relative to the board once the
// focal length is known, and the focal length itself follows from the homographies where the board is seen obliquely
// (Zhang, "A flexible new technique for camera calibration", 2000). The board turns with the disc, so the axis is the
// direction, and the line, that stands still relative to the camera.

#include "capture/calibration/board/board_detection.hpp"
#include "capture/calibration/model/turntable_model.hpp"

#include <optional>
#include <span>
#include <vector>

namespace rs::capture {

// Where the board lies: p_in_object = units_per_mm * object_from_board * p_in_board + middle, at angle 0.
struct BoardPlacement {
    glm::dmat3 object_from_board{1};
    glm::dvec3 middle{0};
    double units_per_mm = 0;  // a unit is the camera's distance from the axis
};

struct BoardTurn {
    TurntableModel model;
    BoardPlacement board;
};

inline constexpr std::size_t kFewestCornersOfView = 6;

// Enough corners, and not all on one line.
bool shows_board(const BoardCorners& view, const BoardDesign& design);

// Focal lengths to begin from, the likeliest first; `lens` gives the size and the principal point.
std::vector<double> likely_focal_lengths(std::span<const BoardCorners> views, const BoardDesign& design,
                                         const Lens& lens);

// All numbers for a lens. Angles count from the first view that shows the board and are as near as can be to the view
// before; those of views that do not show it are 0. Nothing where fewer than three views show the board or no axis is
// found.
std::optional<BoardTurn> board_start(std::span<const BoardCorners> views, const BoardDesign& design, const Lens& lens);

}  // namespace rs::capture
