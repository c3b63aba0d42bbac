#pragma once
// The printed ChArUco board that lies on the turntable and turns with the object: a chessboard whose white squares
// contain ArUco markers, so that every inner corner is identified even if the object hides most of them. One definition
// for printing (board_sheet.hpp), detection (board_detection.hpp) and calibration (board_calibration.hpp).
//
// Squares     Square (x, y) counts from the printed top left, x to the right, y down; it is black if x + y is even.
// Markers     White squares are numbered row by row from 0; that number is the marker's id in the dictionary.
// Corners     Inner corner (x, y) is the lower right corner of square (x, y); id = y * (squares_x - 1) + x.
// Blank       Squares that touch the disc of diameter blank_mm around the board's centre are not printed, and their
//             corners do not exist. The numbering is the same as without it, so a board is also detected with its
//             design without the blank.
// Board frame Millimetres, origin at the board's centre, u to the right and v down as printed. In three dimensions (u,
//             0, v): +Y points out of the printed side.

#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace rs::capture {

struct BoardDesign {
    int squares_x = 9;
    int squares_y = 9;
    double square_mm = 18;
    double marker_share = 0.7;          // side of the marker (with its black border) / side of the square
    std::string dictionary = "4x4_50";  // an ArUco dictionary of OpenCV: NxN_COUNT
    double blank_mm = 0;                // diameter; 0: none
    bool operator==(const BoardDesign&) const = default;
};

/// Parses "squares=9x9,square-mm=18,marker=0.7,dictionary=4x4_50,blank-mm=0" in any order; omitted keys keep their
/// defaults, and "default" or an empty text is the default board. `squares=9` is 9x9. The error contains the invalid
/// word and the valid values.
Result<BoardDesign> parse_board_design(const std::string& text);
std::string to_string(const BoardDesign& design);  // the format that parse_board_design() reads

/// Errors: numbers out of range, too few markers in the dictionary, a blank that leaves fewer than 8 corners.
Status check_board_design(const BoardDesign& design);

// The functions below expect a valid design.

bool square_is_printed(const BoardDesign& design, int x, int y);
bool square_is_black(int x, int y);
int marker_of_square(const BoardDesign& design, int x, int y);  // -1 if it is black or not printed

/// Cell (x, y) of a marker is result[y * n + x], n = marker_cells_across(), including the black border; true if black.
int marker_cells_across(const BoardDesign& design);
std::vector<bool> black_marker_cells(const BoardDesign& design, int marker);

inline int corner_count(const BoardDesign& design) {
    return (design.squares_x - 1) * (design.squares_y - 1);
}
bool corner_is_printed(const BoardDesign& design, int corner);
glm::dvec2 corner_mm(const BoardDesign& design, int corner);  // board frame

/// A black rectangle; millimetres from the top left corner of the board, y down.
struct InkRectangle {
    double x_mm = 0, y_mm = 0, width_mm = 0, height_mm = 0;
};
/// All black areas as rectangles that do not overlap.
std::vector<InkRectangle> ink_rectangles(const BoardDesign& design);

}  // namespace rs::capture
