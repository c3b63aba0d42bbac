// Corner detection in board images rendered through the turntable model, lens distortion included.

#include "capture/calibration/board/board_calibration.hpp"
#include "capture/calibration/board/board_sheet.hpp"
#include "tests/capture/calibration/drawn_board.hpp"

#include <gtest/gtest.h>

#include <random>

namespace rs::capture {
namespace {

using test::compare;
using test::drawn;
using test::Found;
using test::small_turn;

struct Scene {
    const char* name;
    double elevation_deg;
    double roll_deg;
    std::size_t fewest;
};
class BoardDetection : public testing::TestWithParam<Scene> {};

TEST_P(BoardDetection, FindsCornersWithinATenthOfAPixel) {
    test::TurnOptions options;
    options.elevation_deg = GetParam().elevation_deg;
    options.roll_rad = radians(GetParam().roll_deg);
    const BoardTurn turn = small_turn(options, 2);
    for (const std::size_t view : {std::size_t{0}, std::size_t{4}}) {
        SCOPED_TRACE("view " + std::to_string(view));
        const auto seen = detect_board(drawn(turn, {}, view).view(), {});
        ASSERT_TRUE(seen) << seen.error().message;
        const Found found = compare(*seen, turn, {}, view);
        EXPECT_GE(found.count, GetParam().fewest);
        EXPECT_LT(found.rms_px, 0.1);
        EXPECT_LT(found.worst_px, 0.4);
        RecordProperty("rms_px", std::to_string(found.rms_px));
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, BoardDetection,
                         testing::Values(Scene{"Grazing", 15, 0.5, 50}, Scene{"Twenty", 20, 0.5, 60},
                                         Scene{"Sideways", 20, 90, 55}, Scene{"Fortyfive", 45, 0.5, 64},
                                         Scene{"Steep", 70, 0.5, 60}),
                         [](const auto& scene) { return scene.param.name; });

TEST(BoardDetectionOfHidden, WhatAnObjectHidesIsNotSeen) {
    test::TurnOptions options;
    options.elevation_deg = 40;
    const BoardTurn turn = small_turn(options, 3);
    const double hidden_mm = 25;
    const auto seen = detect_board(drawn(turn, {}, 5, hidden_mm).view(), {});
    ASSERT_TRUE(seen);
    const Found found = compare(*seen, turn, {}, 5);
    EXPECT_GE(found.count, 24U);
    EXPECT_LT(found.rms_px, 0.1);
    const double radius_px = hidden_mm * turn.board.units_per_mm * turn.model.lens.f_px;
    for (const DetectedCorner& one : seen->corners) {
        EXPECT_GT(glm::length(one.p - glm::dvec2(512, 384)), radius_px - 1) << one.corner;
    }
}

TEST(BoardDetectionOfHidden, ABlankBoardIsFoundByEitherDesign) {
    test::TurnOptions options;
    options.elevation_deg = 40;
    const BoardTurn turn = small_turn(options, 3);
    BoardDesign blank;
    blank.blank_mm = 60;
    const Image<Rgba8> image = drawn(turn, blank, 2);
    for (const BoardDesign& design : {blank, BoardDesign{}}) {
        const auto seen = detect_board(image.view(), design);
        ASSERT_TRUE(seen);
        const Found found = compare(*seen, turn, design, 2);
        EXPECT_GE(found.count, 24U);
        EXPECT_LT(found.rms_px, 0.1);
        // A white square without its marker is still white, so only a missing black square removes a corner.
        for (const DetectedCorner& one : seen->corners) {
            const int x = one.corner % 8, y = one.corner / 8;
            for (const int dx : {0, 1}) {
                for (const int dy : {0, 1}) {
                    EXPECT_TRUE(!square_is_black(x + dx, y + dy) || square_is_printed(blank, x + dx, y + dy))
                        << one.corner;
                }
            }
        }
    }
}

TEST(BoardDetectionOfHidden, AImageWithoutABoardShowsNone) {
    std::mt19937 random(1);
    Image<std::uint8_t> noise(320, 240);
    for (std::uint8_t& pixel : noise.pixels()) pixel = static_cast<std::uint8_t>(random());
    const auto seen = detect_board(std::as_const(noise).view(), {});
    ASSERT_TRUE(seen);
    EXPECT_TRUE(seen->corners.empty());
    EXPECT_TRUE(detect_board(ConstImageView<std::uint8_t>(), {})->corners.empty());
    BoardDesign wrong;
    wrong.dictionary = "none";
    EXPECT_FALSE(detect_board(std::as_const(noise).view(), wrong));
}

TEST(BoardDetectionOfPrint, ThePrintedImageIsItselfDetected) {
    BoardDesign blank;
    blank.blank_mm = 50;
    BoardDesign other{7, 11, 12, 0.6, "5x5_50", 0};
    for (const BoardDesign& design : {BoardDesign{}, blank, other}) {
        const double dpi = 96;
        const auto image = board_image(design, dpi);
        ASSERT_TRUE(image) << image.error().message;
        const auto seen = detect_board(image->view(), design);
        ASSERT_TRUE(seen);
        std::size_t printed = 0;
        for (int i = 0; i < corner_count(design); ++i) printed += corner_is_printed(design, i) ? 1 : 0;
        EXPECT_EQ(seen->corners.size(), printed);
        const glm::dvec2 middle = design.square_mm * glm::dvec2(0.5 * design.squares_x + 1, 0.5 * design.squares_y + 1);
        for (const DetectedCorner& one : seen->corners) {
            const glm::dvec2 truth = (corner_mm(design, one.corner) + middle) * (dpi / 25.4);
            EXPECT_LT(glm::length(one.p - truth), 0.1) << one.corner;
        }
    }
}

TEST(BoardDetectionOfTurn, ImagesGiveTheModel) {
    test::TurnOptions options;
    options.views = 6;
    options.elevation_deg = 30;
    options.step_rad = radians(60);
    const BoardTurn turn = small_turn(options, 4);
    const auto load = [&](int view) -> Result<Image<Rgba8>> {
        return drawn(turn, {}, static_cast<std::size_t>(view), 20);
    };
    const auto views = detect_boards(options.views, load, {}, nullptr);
    ASSERT_TRUE(views) << views.error().message;
    const auto found = calibrate_with_board(*views, {}, 1024, 768, {});
    ASSERT_TRUE(found) << found.error().message;
    const Calibration& c = found->calibration;
    EXPECT_LT(c.rms_px, 0.15);
    EXPECT_NEAR(c.model.lens.f_px / turn.model.lens.f_px, 1, 0.006);
    EXPECT_NEAR(degrees(c.model.pose.tilt_rad), degrees(turn.model.pose.tilt_rad), 0.1);
    EXPECT_NEAR(degrees(c.model.angles_rad[3]), degrees(turn.model.angles_rad[3]), 0.05);

    const auto failing = [&](int view) -> Result<Image<Rgba8>> {
        return Error{"image " + std::to_string(view) + " is damaged"};
    };
    EXPECT_FALSE(detect_boards(3, failing, {}, nullptr));
}

}  // namespace
}  // namespace rs::capture
