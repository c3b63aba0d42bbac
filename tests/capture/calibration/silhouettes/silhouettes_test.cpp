#include "capture/calibration/silhouettes/silhouettes.hpp"

#include "rayspace/base/conventions.hpp"
#include "tests/capture/calibration/drawn_figure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kViews = 24;

TurntableModel level_start(const TurntableModel& truth) {
    TurntableModel start = truth;
    start.pose = {};
    start.lens.f_px = 1.2 * truth.lens.f_px;
    return start;
}

double axis_error_px(const TurntableModel& found, const TurntableModel& truth) {
    double worst = 0;
    for (const double y : {60.0, 180.0}) {
        const auto a = axis_column(found.lens, found.pose, y);
        const auto b = axis_column(truth.lens, truth.pose, y);
        EXPECT_TRUE(a && b);
        if (a && b) worst = std::max(worst, std::abs(*a - *b));
    }
    return worst;
}

// Without the mean, which is a convention.
double angles_rms_deg(const TurntableModel& found, const TurntableModel& truth) {
    const auto n = static_cast<double>(truth.angles_rad.size());
    double sum = 0;
    double squares = 0;
    for (std::size_t i = 0; i < truth.angles_rad.size(); ++i) {
        const double off = degrees(found.angles_rad[i] - truth.angles_rad[i]);
        sum += off / n;
        squares += off * off / n;
    }
    return std::sqrt(squares - sum * sum);
}

const std::vector<Image<std::uint8_t>>& figure_masks() {
    static const auto kMasks = drawn(figure(), turn_of_figure(kViews));
    return kMasks;
}

TEST(Silhouettes, FindAxisTiltAndRollOfABodyWithoutSymmetry) {
    const TurntableModel truth = turn_of_figure(kViews);
    const auto found = calibrate_with_silhouettes(figure_masks(), level_start(truth), {});
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_EQ(found->method, CalibrationMethod::kSilhouettes);
    EXPECT_LT(axis_error_px(found->model, truth), 0.3);
    EXPECT_NEAR(degrees(found->model.pose.tilt_rad), 15, 0.5);
    EXPECT_NEAR(degrees(found->model.pose.roll_rad), 1, 0.1);
    EXPECT_NEAR(found->model.lens.f_px, truth.lens.f_px, 0.02 * truth.lens.f_px);
    EXPECT_LT(found->rms_px, 0.2);
    EXPECT_EQ(found->views.size(), static_cast<std::size_t>(kViews));
    EXPECT_LT(angles_rms_deg(found->model, truth), 0.15);
    EXPECT_NEAR(degrees(found->step_rad), 360.0 / kViews, 0.1);
    EXPECT_TRUE(found->warnings.empty()) << found->warnings[0];
    // The deviations cover the errors and are small enough to be useful.
    const ModelDeviations& d = found->deviations;
    EXPECT_GT(3 * d.tilt_rad, std::abs(found->model.pose.tilt_rad - radians(15)));
    EXPECT_LT(d.tilt_rad, radians(1.5));
    EXPECT_LT(d.roll_rad, radians(0.3));
    EXPECT_LT(d.axis_position_px, 0.5);
    EXPECT_LT(d.f_px, 0.1 * truth.lens.f_px);
    EXPECT_LT(d.angles_rad[3], radians(1));
    EXPECT_TRUE(std::isinf(d.cx));  // the principal point is assumed
}

TEST(Silhouettes, FindStepsThatAreNotEqual) {
    TurntableModel truth = turn_of_figure(kViews);
    for (std::size_t i = 1; i < truth.angles_rad.size(); ++i) {
        truth.angles_rad[i] += radians(2.5 * std::sin(2.1 * static_cast<double>(i)));
    }
    const auto masks = drawn(figure(), truth);
    const TurntableModel start = level_start(turn_of_figure(kViews));
    const auto found = calibrate_with_silhouettes(masks, start, {});
    ASSERT_TRUE(found.ok()) << found.error().message;
    const double off_deg = angles_rms_deg(found->model, truth);
    EXPECT_GT(angles_rms_deg(start, truth), 1.5);
    EXPECT_LT(off_deg, 0.25);
    double sum = 0;
    for (const double d : found->deviations.angles_rad) sum += d * d;
    const double stated_deg = degrees(std::sqrt(sum / kViews));
    EXPECT_LT(off_deg, 2 * stated_deg);
    EXPECT_LT(stated_deg, 1);
    EXPECT_NEAR(degrees(found->model.pose.tilt_rad), 15, 0.5);

    KnownInputs equal;
    equal.equal_steps = true;
    const auto held = calibrate_with_silhouettes(masks, start, equal);
    ASSERT_TRUE(held.ok()) << held.error().message;
    const std::vector<double>& angles_rad = held->model.angles_rad;
    for (std::size_t i = 0; i < angles_rad.size(); ++i) {
        EXPECT_NEAR(angles_rad[i], static_cast<double>(i) * angles_rad[1], 1e-9) << i;
    }
    EXPECT_NEAR(degrees(angles_rad[1]), 360.0 / kViews, 0.1);
}

// With masks smaller than the photos.
TEST(Silhouettes, HoldKnownValuesConstant) {
    const TurntableModel truth = turn_of_figure(kViews);
    TurntableModel start = level_start(truth);
    for (double* number : {&start.lens.f_px, &start.lens.cx, &start.lens.cy}) *number *= 4;
    start.lens.width *= 4;
    start.lens.height *= 4;
    KnownInputs known;
    known.f_px = 4 * truth.lens.f_px;
    known.step_rad = radians(360.0 / kViews);
    known.distortion = glm::dvec2(0);
    const auto found = calibrate_with_silhouettes(figure_masks(), start, known);
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_EQ(found->model.lens.f_px, *known.f_px);
    EXPECT_EQ(found->model.lens.width, 1280);
    EXPECT_EQ(found->deviations.f_px, 0);
    EXPECT_EQ(found->deviations.k1, 0);
    EXPECT_EQ(found->deviations.angles_rad[3], 0);
    EXPECT_NEAR(degrees(found->model.pose.tilt_rad), 15, 0.5);
    const auto axis = axis_column(found->model.lens, found->model.pose, 4 * 120);
    const auto expected = axis_column(truth.lens, truth.pose, 120);
    ASSERT_TRUE(axis && expected);
    EXPECT_NEAR(*axis, 4 * *expected, 4 * 0.3);
}

TEST(Silhouettes, DoNotPretendToKnowWhatABodyOfRevolutionHides) {
    const TurntableModel truth = turn_of_figure(24);
    TurntableModel one_view = truth;
    one_view.angles_rad = {0};
    const std::vector<Image<std::uint8_t>> masks(24, drawn(bottle(), one_view)[0]);
    const auto found = calibrate_with_silhouettes(masks, level_start(truth), {});
    ASSERT_TRUE(found.ok()) << found.error().message;
    // The position of the axis in the image is determined.
    EXPECT_LT(axis_error_px(found->model, truth), 1);
    const ModelDeviations& d = found->deviations;
    EXPECT_GT(d.tilt_rad, radians(10));
    EXPECT_GT(3 * d.tilt_rad, std::abs(found->model.pose.tilt_rad - truth.pose.tilt_rad));
    EXPECT_GT(3 * d.roll_rad, std::abs(found->model.pose.roll_rad - truth.pose.roll_rad));
    EXPECT_GT(3 * d.f_px, std::abs(found->model.lens.f_px - truth.lens.f_px));
    EXPECT_LT(std::abs(found->model.pose.tilt_rad), radians(20));
    EXPECT_TRUE(std::isinf(d.angles_rad[3]));
    EXPECT_LT(angles_rms_deg(found->model, truth), 0.01);  // equal to the start
    ASSERT_FALSE(found->warnings.empty());
    EXPECT_NE(found->warnings[0].find("how far the camera looks down"), std::string::npos);
}

TEST(Silhouettes, RefuseSilhouettesThatAreNoTurn) {
    const TurntableModel truth = turn_of_figure(kViews);
    auto shuffled = figure_masks();
    for (std::size_t i = 0; i < shuffled.size(); ++i) std::swap(shuffled[i], shuffled[(i * 11 + 5) % kViews]);
    const auto found = calibrate_with_silhouettes(shuffled, level_start(truth), {});
    ASSERT_FALSE(found.ok());
    EXPECT_NE(found.error().message.find("check the steps"), std::string::npos);
}

TEST(Silhouettes, RefuseInputsThatDoNotFitTogether) {
    const TurntableModel truth = turn_of_figure(kViews);
    const auto message = [&](std::vector<Image<std::uint8_t>> masks, const TurntableModel& start) {
        const auto found = calibrate_with_silhouettes(masks, start, {});
        return found.ok() ? std::string("accepted") : found.error().message;
    };
    auto masks = figure_masks();
    masks[4] = Image<std::uint8_t>(320, 240);
    EXPECT_NE(message(masks, truth).find("view 5 shows no object"), std::string::npos);
    masks[4] = Image<std::uint8_t>(320, 240, 255);
    EXPECT_NE(message(masks, truth).find("view 5 has hardly any contour"), std::string::npos);
    masks[4] = Image<std::uint8_t>(32, 24, 255);
    EXPECT_NE(message(masks, truth).find("view 5 differs in size"), std::string::npos);
    masks.resize(3);
    EXPECT_NE(message(masks, truth).find("3 views are too few"), std::string::npos);
    TurntableModel other = truth;
    other.angles_rad.pop_back();
    EXPECT_NE(message(figure_masks(), other).find("23 angles"), std::string::npos);
    other = truth;
    other.lens.width = 400;
    EXPECT_NE(message(figure_masks(), other).find("no reduced images"), std::string::npos);
}

TEST(Silhouettes, TheOtherSenseOfTurningIsNoticed) {
    const TurntableModel truth = turn_of_figure(kViews);
    TurntableModel start = level_start(truth);
    for (double& angle : start.angles_rad) angle = -angle;
    const auto found = calibrate_with_silhouettes(figure_masks(), start, {});
    if (found.ok()) {
        ASSERT_FALSE(found->warnings.empty());
        EXPECT_NE(found->warnings[0].find("the other direction of turning"), std::string::npos) << found->warnings[0];
        EXPECT_LT(found->model.pose.tilt_rad, 0);
    } else {
        EXPECT_NE(found.error().message.find("direction of turning"), std::string::npos);
    }
}

}  // namespace
}  // namespace rs::capture
