// Board calibration from synthetic corners: errors, and whether the stated deviations cover them.

#include "capture/calibration/board/board_calibration.hpp"

#include "tests/capture/calibration/board_turns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rs::capture {
namespace {

using test::corners_of;
using test::make_turn;
using test::TurnOptions;

constexpr int kSeeds = 20;

struct Errors {
    double axis_direction_rad = 0, axis_px = 0, f_share = 0, angle_rad = 0;
};

glm::dvec3 axis_in_camera(const TurntableModel& model) {
    return camera_rotation(model.pose) * glm::dvec3(0, 1, 0);
}

double axis_px(const TurntableModel& model) {
    const bool sideways = std::abs(std::sin(model.pose.roll_rad)) > 0.7;
    return sideways ? axis_row(model.lens, model.pose, 0.5 * model.lens.width).value_or(-1e9)
                    : axis_column(model.lens, model.pose, 0.5 * model.lens.height).value_or(-1e9);
}

std::vector<double> angles_from_mean(const TurntableModel& model) {
    std::vector<double> angles = model.angles_rad;
    double mean = 0;
    for (const double angle : angles) mean += angle / static_cast<double>(angles.size());
    for (double& angle : angles) angle -= mean;
    return angles;
}

Errors errors_of(const TurntableModel& found, const TurntableModel& truth) {
    Errors errors;
    errors.axis_direction_rad = std::asin(glm::length(glm::cross(axis_in_camera(found), axis_in_camera(truth))));
    errors.axis_px = std::abs(axis_px(found) - axis_px(truth));
    errors.f_share = std::abs(found.lens.f_px / truth.lens.f_px - 1);
    const auto a = angles_from_mean(found), b = angles_from_mean(truth);
    for (std::size_t i = 0; i < a.size(); ++i) errors.angle_rad = std::max(errors.angle_rad, std::abs(a[i] - b[i]));
    return errors;
}

void expect_within_bars(const Errors& errors) {
    EXPECT_LT(degrees(errors.axis_direction_rad), 0.03);
    EXPECT_LT(errors.axis_px, 0.2);
    EXPECT_LT(errors.f_share, 0.003);
    EXPECT_LT(degrees(errors.angle_rad), 0.05);
}

TEST(BoardCalibration, TwentyDegreesAboveIsWithinTheBarsAndDeviationsCoverTheErrors) {
    int covered = 0, judged = 0;
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const BoardTurn truth = make_turn({}, seed);
        const auto views = corners_of(truth, {}, 0.1, 0.3, seed + 100);
        const auto found = calibrate_with_board(views, {}, 1600, 1200, {});
        ASSERT_TRUE(found) << found.error().message;
        const Calibration& c = found->calibration;
        const Errors errors = errors_of(c.model, truth.model);
        expect_within_bars(errors);
        EXPECT_NEAR(c.rms_px, 0.1 * std::sqrt(2.0), 0.01);
        EXPECT_NEAR(c.held_out_rms_px.value_or(0), 0.1 * std::sqrt(2.0), 0.04);
        EXPECT_NEAR(found->mm_per_unit * truth.board.units_per_mm, 1, 0.003);
        EXPECT_NEAR(found->plane_offset, truth.board.object_from_board[1].y * truth.board.middle.y, 0.01);
        const auto judge = [&](double error, double deviation) {
            EXPECT_TRUE(std::isfinite(deviation) && deviation > 0);
            covered += std::abs(error) <= 2 * deviation ? 1 : 0;
            ++judged;
        };
        judge(c.model.lens.f_px - truth.model.lens.f_px, c.deviations.f_px);
        judge(c.model.lens.k1 - truth.model.lens.k1, c.deviations.k1);
        judge(c.model.pose.tilt_rad - truth.model.pose.tilt_rad, c.deviations.tilt_rad);
        judge(c.model.pose.roll_rad - truth.model.pose.roll_rad, c.deviations.roll_rad);
        judge(axis_px(c.model) - axis_px(truth.model), c.deviations.axis_position_px);
        const auto a = angles_from_mean(c.model), b = angles_from_mean(truth.model);
        for (const std::size_t view : {std::size_t{0}, std::size_t{7}, std::size_t{22}}) {
            judge(a[view] - b[view], c.deviations.angles_rad[view]);
        }
    }
    EXPECT_GE(covered, 0.9 * judged) << covered << " of " << judged;
    RecordProperty("covered", covered);
}

TEST(BoardCalibration, WorksFromFifteenToSeventyDegreesAboveAndWithASidewaysAxis) {
    for (const double elevation : {15.0, 35.0, 50.0, 70.0}) {
        for (const double roll : {0.01, radians(90.0), radians(-88.0), radians(180.0)}) {
            SCOPED_TRACE(std::to_string(elevation) + " degrees above, roll " + std::to_string(degrees(roll)));
            TurnOptions options;
            options.elevation_deg = elevation;
            options.roll_rad = roll;
            const BoardTurn truth = make_turn(options, 3);
            const auto views = corners_of(truth, {}, 0.1, 0.6, 4);
            const auto found = calibrate_with_board(views, {}, 1600, 1200, {});
            ASSERT_TRUE(found) << found.error().message;
            const Errors errors = errors_of(found->calibration.model, truth.model);
            const ModelDeviations& d = found->calibration.deviations;
            EXPECT_LT(errors.axis_direction_rad, std::max(radians(0.03), 4 * d.axis_direction_rad));
            EXPECT_LT(errors.axis_px, std::max(0.2, 4 * d.axis_position_px));
            EXPECT_LT(errors.f_share, 0.02);
            EXPECT_LT(degrees(d.axis_direction_rad), 0.2);
        }
    }
}

TEST(BoardCalibration, WrongCornersAreDropped) {
    const BoardTurn truth = make_turn({}, 5);
    auto views = corners_of(truth, {}, 0.1, 0.3, 6);
    int wrong = 0;
    for (std::size_t i = 0; i < views.size(); ++i) {
        for (std::size_t k = i % 17; k < views[i].corners.size(); k += 17, ++wrong) {
            views[i].corners[k].p += glm::dvec2(3 + static_cast<double>(k), -5);
        }
    }
    const auto found = calibrate_with_board(views, {}, 1600, 1200, {});
    ASSERT_TRUE(found) << found.error().message;
    expect_within_bars(errors_of(found->calibration.model, truth.model));
    EXPECT_NEAR(found->outliers, wrong, 3);
}

TEST(BoardCalibration, TheTurningDirectionIsMeasured) {
    for (const double sign : {1.0, -1.0}) {
        TurnOptions options;
        options.step_rad *= sign;
        const BoardTurn truth = make_turn(options, 7);
        KnownInputs known;
        known.counter_clockwise = true;
        const auto found = calibrate_with_board(corners_of(truth, {}, 0.1, 0.3, 8), {}, 1600, 1200, known);
        ASSERT_TRUE(found) << found.error().message;
        EXPECT_NEAR(found->calibration.step_rad, options.step_rad, 0.02);
        EXPECT_EQ(found->calibration.warnings.size(), sign > 0 ? 0U : 1U);
    }
}

TEST(BoardCalibration, WhatIsKnownIsHeld) {
    TurnOptions options;
    options.step_jitter_rad = 0;
    const BoardTurn truth = make_turn(options, 9);
    const auto views = corners_of(truth, {}, 0.1, 0.3, 10);
    KnownInputs known;
    known.f_px = truth.model.lens.f_px;
    known.distortion = glm::dvec2(truth.model.lens.k1, truth.model.lens.k2);
    known.step_rad = options.step_rad;
    known.pose = truth.model.pose;
    const auto found = calibrate_with_board(views, {}, 1600, 1200, known);
    ASSERT_TRUE(found) << found.error().message;
    const Calibration& c = found->calibration;
    EXPECT_EQ(c.model.lens.f_px, *known.f_px);
    EXPECT_EQ(c.model.lens.k1, known.distortion->x);
    EXPECT_EQ(c.model.pose.tilt_rad, known.pose->tilt_rad);
    EXPECT_EQ(c.model.angles_rad[9], 9 * options.step_rad);
    EXPECT_EQ(c.deviations.f_px, 0);
    EXPECT_EQ(c.deviations.tilt_rad, 0);
    EXPECT_EQ(c.deviations.angles_rad[9], 0);
    EXPECT_NEAR(c.rms_px, 0.1 * std::sqrt(2.0), 0.01);

    known = {};
    known.step_rad = -options.step_rad;  // wrong direction
    const auto wrong = calibrate_with_board(views, {}, 1600, 1200, known);
    ASSERT_FALSE(wrong);
    EXPECT_NE(wrong.error().message.find("direction of turning"), std::string::npos) << wrong.error().message;
}

TEST(BoardCalibration, EqualStepsBridgeViewsWithoutABoard) {
    TurnOptions options;
    options.step_jitter_rad = 0;
    const BoardTurn truth = make_turn(options, 11);
    auto views = corners_of(truth, {}, 0.1, 0.3, 12);
    views[0].corners.clear();
    views[20].corners.resize(3);
    KnownInputs known;
    const auto refused = calibrate_with_board(views, {}, 1600, 1200, known);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("view 0, view 20"), std::string::npos) << refused.error().message;

    known.equal_steps = true;
    const auto found = calibrate_with_board(views, {}, 1600, 1200, known);
    ASSERT_TRUE(found) << found.error().message;
    const Calibration& c = found->calibration;
    expect_within_bars(errors_of(c.model, truth.model));
    EXPECT_EQ(c.views[20].observations, 0);
    ASSERT_EQ(c.warnings.size(), 1U);
    EXPECT_NE(c.warnings[0].find("view 20"), std::string::npos);
}

TEST(BoardCalibration, TooFewViewsWithABoardAreAnError) {
    const BoardTurn truth = make_turn({}, 13);
    auto views = corners_of(truth, {}, 0.1, 0, 14);
    for (std::size_t i = 2; i < views.size(); ++i) views[i].corners.resize(4);
    const auto found = calibrate_with_board(views, {}, 1600, 1200, {});
    ASSERT_FALSE(found);
    EXPECT_NE(found.error().message.find("2 of 36 views"), std::string::npos) << found.error().message;
    EXPECT_FALSE(calibrate_with_board({}, {}, 1600, 1200, {}));
}

TEST(BoardCalibration, TheResultDoesNotChangeFromRunToRun) {
    const BoardTurn truth = make_turn({}, 15);
    const auto views = corners_of(truth, {}, 0.1, 0.3, 16);
    const auto a = calibrate_with_board(views, {}, 1600, 1200, {});
    const auto b = calibrate_with_board(views, {}, 1600, 1200, {});
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->calibration.model.angles_rad, b->calibration.model.angles_rad);
    EXPECT_EQ(a->calibration.model.lens.f_px, b->calibration.model.lens.f_px);
}

}  // namespace
}  // namespace rs::capture
