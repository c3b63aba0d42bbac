#pragma once
// Initial values for calibrating with a board, from the corners alone. Runs between detection and bundle adjustment.
//
// Each view's homography from the board's plane to the image gives the camera's pose relative to the board once the
// focal length is known; the focal length follows from the homographies of oblique views (Zhang, "A flexible new
// technique for camera calibration", 2000). The board turns with the disc, so the axis is the line that is fixed
// relative to the camera.

#include "capture/calibration/board/board_detection.hpp"
#include "capture/calibration/model/turntable_model.hpp"

#include <optional>
#include <span>
#include <vector>

namespace rs::capture {

/// Placement of the board at angle 0: p_in_object = units_per_mm * object_from_board * p_in_board + middle.
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

/// True if the view has enough corners that are not all on one line.
bool has_board(const BoardCorners& view, const BoardDesign& design);

/// Candidate focal lengths in px, the likeliest first; `lens` gives the image size and the principal point.
std::vector<double> estimate_focal_lengths(std::span<const BoardCorners> views, const BoardDesign& design,
                                           const Lens& lens);

/// Estimates pose, angles and board placement for a lens. Angles are relative to the first view that shows the board
/// and differ by at most half a turn from that of the view before; those of views without the board are 0. Returns
/// nothing if fewer than three views show the board or no axis is found.
std::optional<BoardTurn> initialize_board_turn(std::span<const BoardCorners> views, const BoardDesign& design,
                                               const Lens& lens);

}  // namespace rs::capture
