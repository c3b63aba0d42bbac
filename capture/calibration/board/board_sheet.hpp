#pragma once
// Printable calibration board: a PDF page with exact millimetres, an SVG drawing, or an image.
//
// The PDF page has the size of a sheet of paper; SVG and image have a white border of one square around the board. All
// have a caption below the board with its design and the instruction to print at 100 %.

#include "capture/calibration/board/charuco_board.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs::capture {

std::vector<std::string> paper_names();  // "a4" etc.

struct SheetOptions {
    BoardDesign design;
    std::string paper = "a4";  // PDF only; portrait or landscape, whichever fits the board
    double dpi = 300;          // PNG only
};

/// Errors: a design that check_board_design() refuses; an unknown paper; a board that does not fit the paper (the
/// message states what would fit).
Result<std::string> board_pdf(const BoardDesign& design, const std::string& paper);
Result<std::string> board_svg(const BoardDesign& design);

/// Edges are antialiased by pixel coverage, so sizes are exact even if a square is not a whole number of pixels: pixel
/// p covers [p, p + 1) * 25.4 / dpi millimetres from the border's outer edge. Error if a side exceeds kMaxImageSide_px.
Result<Image<Rgba8>> board_image(const BoardDesign& design, double dpi);

/// Writes the format given by the extension: .pdf, .svg or .png. Errors: those above, another extension, a failed
/// write.
Status write_board(const std::filesystem::path& path, const SheetOptions& options);

}  // namespace rs::capture
