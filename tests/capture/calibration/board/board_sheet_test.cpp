// The printed board: parsing of designs, and exact sizes on paper.

#include "capture/calibration/board/board_sheet.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

namespace rs::capture {
namespace {

constexpr double kPoints_per_mm = 72.0 / 25.4;

TEST(BoardDesign, WordsSurviveARoundTrip) {
    const BoardDesign other{7, 11, 12.5, 0.6, "5x5_100", 40};
    for (const BoardDesign& design : {BoardDesign{}, other}) {
        const auto read = parse_board_design(to_string(design));
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(*read, design);
    }
    EXPECT_EQ(*parse_board_design(""), BoardDesign{});
    EXPECT_EQ(*parse_board_design("default"), BoardDesign{});
    EXPECT_EQ(parse_board_design("squares=8")->squares_y, 8);
}

TEST(BoardDesign, WrongWordsAreRefusedByName) {
    for (const char* text : {"squares=2", "squares=9x", "square-mm=0", "square-mm=nan", "marker=1", "colour=red",
                             "dictionary=6x6", "blank-mm=-1", "blank-mm=500", "squares=12", "square-mm"}) {
        const auto read = parse_board_design(text);
        ASSERT_FALSE(read) << text;
        EXPECT_NE(read.error().message.find("give"), read.error().message.find("write")) << read.error().message;
    }
    EXPECT_NE(parse_board_design("squares=12").error().message.find("4x4_100"), std::string::npos);
}

TEST(BoardDesign, BlankTakesSquaresAndCornersOutOfTheMiddleOnly) {
    BoardDesign design;
    design.blank_mm = 60;
    EXPECT_FALSE(square_is_printed(design, 4, 4));
    EXPECT_TRUE(square_is_printed(design, 0, 0));
    EXPECT_EQ(marker_of_square(design, 1, 0), 0);
    EXPECT_EQ(marker_of_square(design, 7, 8), marker_of_square(BoardDesign{}, 7, 8));
    EXPECT_FALSE(corner_is_printed(design, 3 * 8 + 3));
    EXPECT_TRUE(corner_is_printed(design, 0));
}

// Parses "MediaBox [0 0 W H]" and every "x y w h re" of the page's content, in points.
TEST(BoardPdf, HasExactMillimetres) {
    const BoardDesign design;
    const auto pdf = board_pdf(design, "a4");
    ASSERT_TRUE(pdf) << pdf.error().message;
    const std::size_t box = pdf->find("/MediaBox [0 0 ");
    ASSERT_NE(box, std::string::npos);
    std::istringstream size(pdf->substr(box + 15));
    double width = 0, height = 0;
    size >> width >> height;
    EXPECT_NEAR(width, 210 * kPoints_per_mm, 1e-3);
    EXPECT_NEAR(height, 297 * kPoints_per_mm, 1e-3);

    // The matrix maps millimetres to points; the union of the squares is the board.
    std::istringstream lines(*pdf);
    double scale = 0, left = 0, right = 0, bottom = 0;
    int squares = 0;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        double a = 0, b = 0, c = 0, d = 0;
        if (line.ends_with(" cm")) {
            double unused = 0;
            words >> scale >> unused >> unused >> d >> left;
            EXPECT_EQ(d, -scale);
        } else if (line.ends_with(" re")) {
            words >> a >> b >> c >> d;
            right = std::max(right, a + c);
            bottom = std::max(bottom, b + d);
            squares += c == design.square_mm && d == design.square_mm ? 1 : 0;
        }
    }
    EXPECT_NEAR(scale, kPoints_per_mm, 1e-4);
    EXPECT_NEAR(scale * 162, 162 * kPoints_per_mm, 0.01);  // 4 microns over the board
    EXPECT_NEAR(left, 0.5 * (210 - 162) * kPoints_per_mm, 1e-3);
    EXPECT_EQ(right, 162);
    EXPECT_EQ(bottom, 162);
    EXPECT_EQ(squares, 41);
    EXPECT_NE(pdf->find("Print at 100 %"), std::string::npos);
    EXPECT_NE(pdf->find("a square is 18 mm"), std::string::npos);
}

TEST(BoardPdf, TheTableSaysWhereEachObjectBegins) {
    const auto pdf = board_pdf({}, "letter");
    ASSERT_TRUE(pdf);
    const std::size_t table = std::strtoul(pdf->substr(pdf->find("startxref\n") + 10).c_str(), nullptr, 10);
    ASSERT_EQ(pdf->substr(table, 5), "xref\n");
    for (std::size_t i = 1; i <= 6; ++i) {
        const std::string entry = pdf->substr(pdf->find('\n', table + 5) + 1 + 20 * i, 20);
        const std::size_t at = std::strtoul(entry.c_str(), nullptr, 10);
        EXPECT_EQ(pdf->substr(at, 7), std::to_string(i) + " 0 obj") << entry;
    }
}

TEST(BoardPdf, WhatDoesNotFitIsRefusedWithWhatFits) {
    BoardDesign design;
    design.square_mm = 25;
    const auto pdf = board_pdf(design, "a4");
    ASSERT_FALSE(pdf);
    EXPECT_NE(pdf.error().message.find("at most 21.5 mm"), std::string::npos) << pdf.error().message;
    EXPECT_NE(pdf.error().message.find("--paper tabloid"), std::string::npos) << pdf.error().message;
    design.square_mm = 21.5;
    EXPECT_TRUE(board_pdf(design, "a4"));
    design.square_mm = 25;
    EXPECT_TRUE(board_pdf(design, "a3"));
    EXPECT_FALSE(board_pdf({}, "napkin"));
    design = {12, 8, 18, 0.7, "4x4_50", 0};
    EXPECT_TRUE(board_pdf(design, "a4")) << "fits in landscape";
}

TEST(BoardImage, HasABorderOfOneSquareAndARefusedSizeIsAnError) {
    const auto image = board_image({}, 254);
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width(), 11 * 180);
    EXPECT_EQ((*image)(179, 179).r, 255);
    EXPECT_EQ((*image)(180, 180).r, 0);
    EXPECT_EQ((*image)(359, 359).r, 0);
    EXPECT_EQ((*image)(360, 180).r, 255);
    EXPECT_FALSE(board_image({}, 2400));
    EXPECT_FALSE(board_image({}, 0));
}

TEST(BoardSvg, HasTheSizeInMillimetres) {
    const auto svg = board_svg({});
    ASSERT_TRUE(svg);
    EXPECT_NE(svg->find("width=\"198.0000mm\" height=\"198.0000mm\""), std::string::npos);
}

}  // namespace
}  // namespace rs::capture
