#pragma once
// Photographs of the printed board -> where its numbered corners stand in each. First step of calibrating with a board;
// board_calibration.hpp is the next.
//
// Markers give the first idea of where the board lies; in a steep foreshortening, where their cells are a few pixels
// high, they are looked for in the stretched image too. Every corner is then refined in a small window that is
// rectified with the board, so that it is as wide along the foreshortened direction as along the other, and only from
// the cross of the four squares' edges, so that the markers beside them do not pull. A corner counts only if its four
// squares look as they should: what the object hides is left out. The lens' distortion need not be known: nothing is
// taken to be straight for longer than three squares.

#include "capture/calibration/board/charuco_board.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace rs::capture {

struct SeenCorner {
    int corner = 0;  // number of charuco_board.hpp
    glm::dvec2 p;    // px, centres at +0.5
};

// The corners of one view in ascending order of their numbers; none where no board is seen.
struct BoardCorners {
    std::vector<SeenCorner> corners;
};

// Error only where OpenCV refuses to work or the design is wrong; a view without a board is no error. May be called
// from any thread.
Result<BoardCorners> detect_board(ConstImageView<std::uint8_t> grey, const BoardDesign& design);
// Colours are weighed as in luma; alpha is ignored.
Result<BoardCorners> detect_board(ConstImageView<Rgba8> image, const BoardDesign& design);

// All views side by side on the calling tbb arena; load(i) gives image i and is called from any thread. The result
// does not depend on the number of threads.
Result<std::vector<BoardCorners>> detect_boards(int views, const std::function<Result<Image<Rgba8>>(int)>& load,
                                                const BoardDesign& design, Progress* progress);

}  // namespace rs::capture
