#pragma once
// The calibration board as something to print: a PDF page with exact millimetres, an SVG drawing, or an image.
//
// The PDF stands on a sheet of paper; SVG and image show the board with a white border of one square around it. All
// say in small print below the board what it is and that it is to be printed at 100 %.

#include "capture/calibration/board/charuco_board.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs::capture {

std::vector<std::string> paper_names();  // "a4" and so on

struct SheetOptions {
    BoardDesign design;
    std::string paper = "a4";  // PDF only; upright or on its side, whichever holds the board
    double dpi = 300;          // PNG only
};

// Errors: a design that check_board_design() refuses; an unknown paper; a board that does not fit the paper (the
// message states what would fit).
Result<std::string> board_pdf(const BoardDesign& design, const std::string& paper);
Result<std::string> board_svg(const BoardDesign& design);

// Edges are mixed by coverage, so sizes are exact though a square is no whole number of pixels: pixel p covers
// [p, p + 1) * 25.4 / dpi millimetres from the border's outer edge. Error where a side exceeds kMaxImageSide_px.
Result<Image<Rgba8>> board_image(const BoardDesign& design, double dpi);

// Writes what the name's ending names: .pdf, .svg or .png. Errors as above, another ending, and of writing.
Status write_board(const std::filesystem::path& path, const SheetOptions& options);

}  // namespace rs::capture
