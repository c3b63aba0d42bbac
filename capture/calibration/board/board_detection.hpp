#pragma once
// Detects the numbered corners of the printed board in photos. First step of calibrating with a board;
// board_calibration.hpp is the next.
//
// Markers give the first estimate of the board's pose; under steep foreshortening, where their cells are a few pixels
// high, they are detected in stretched copies of the image too. Every corner is then refined in a small window that is
// rectified with the board, so that the window is as wide along the foreshortened direction as along the other.
// Refinement uses only the cross formed by the edges of the four squares, so that adjacent markers do not bias it. A
// corner is accepted only if its four squares match a chessboard, which rejects corners hidden by the object. The lens
// distortion need not be known: lines are assumed straight over at most three squares.

#include "capture/calibration/board/charuco_board.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace rs::capture {

struct DetectedCorner {
    int corner = 0;  // number as in charuco_board.hpp
    glm::dvec2 p;    // px, centres at +0.5
};

/// The corners of one view in ascending order of their numbers; empty if no board is detected.
struct BoardCorners {
    std::vector<DetectedCorner> corners;
};

/// Fails only if OpenCV throws or the design is invalid; a view without a board is not an error. Thread-safe.
Result<BoardCorners> detect_board(ConstImageView<std::uint8_t> grey, const BoardDesign& design);
/// Converts the image to luma; alpha is ignored.
Result<BoardCorners> detect_board(ConstImageView<Rgba8> image, const BoardDesign& design);

/// Detects the board in all views in parallel on the calling tbb arena; load(i) returns image i and is called from any
/// thread. The result does not depend on the number of threads.
Result<std::vector<BoardCorners>> detect_boards(int views, const std::function<Result<Image<Rgba8>>(int)>& load,
                                                const BoardDesign& design, Progress* progress);

}  // namespace rs::capture
