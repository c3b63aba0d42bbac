// Axis from the region that the silhouettes of a turn cover together, for asymmetric bodies with a known axis.

#include "capture/calibration/silhouettes/silhouette_symmetry.hpp"

#include "rayspace/base/conventions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rs::capture {
namespace {

struct Ball {
    glm::dvec3 centre{0};
    double radius = 0;
};

// An asymmetric body: one arm, and a trunk beside the axis.
std::vector<Ball> balls() {
    return {{{0.03, -0.24, 0.02}, 0.07},
            {{0.05, -0.30, -0.01}, 0.09},
            {{0.12, -0.33, 0.03}, 0.05},
            {{-0.02, -0.38, 0.04}, 0.10},
            {{-0.04, -0.46, -0.05}, 0.06}};
}

TurntableModel turn_of_silhouettes(int views, double roll_rad = 0.01) {
    TurntableModel model;
    model.lens = {400, 320, 620, 200, 160, -0.1, 0};
    model.pose = {0.03, radians(20), roll_rad};
    for (int i = 0; i < views; ++i) model.angles_rad.push_back(-2 * kPi * i / views);
    return model;
}

// `on_left_px`: width that is missing at the left side of all masks.
Image<std::uint8_t> covered_of(const TurntableModel& model, int on_left_px = 0) {
    std::vector<CalibrationImage> images;
    for (const double angle : model.angles_rad) {
        Image<std::uint8_t> alpha(model.lens.width, model.lens.height);
        for (int y = 0; y < alpha.height(); ++y) {
            for (int x = 0; x < alpha.width(); ++x) {
                const auto ray = table_ray(model.lens, model.pose, {x + 0.5, y + 0.5});
                double inside_px = -1;
                for (const Ball& ball : balls()) {
                    const glm::dvec3 to_centre = turned(ball.centre, angle) - glm::dvec3(0, 0, 1);
                    const double along = glm::dot(to_centre, *ray);
                    const double beside = std::sqrt(std::max(0.0, glm::dot(to_centre, to_centre) - along * along));
                    inside_px = std::max(inside_px, (ball.radius - beside) / along * model.lens.f_px);
                }
                alpha(x, y) = static_cast<std::uint8_t>(std::lround(255 * std::clamp(inside_px + 0.5, 0.0, 1.0)));
            }
        }
        Image<std::uint8_t> cut = alpha;
        for (int y = 0; y < alpha.height(); ++y) {
            for (int x = 0; x < on_left_px; ++x) cut(x, y) = 0;
            for (int x = on_left_px; x < alpha.width(); ++x)
                cut(x, y) = std::min(alpha(x, y), alpha(x - on_left_px, y));
        }
        images.push_back({{}, std::move(cut)});
    }
    return union_of_alphas(images);
}

double error_px(const TurntableModel& truth, const AxisPosition& found) {
    return found.position_px - axis_position(truth.lens, truth.pose, found.at_px).value();
}

TEST(SilhouetteSymmetry, FindsTheAxisFromAStartBesideIt) {
    const TurntableModel truth = turn_of_silhouettes(36);
    const Image<std::uint8_t> covered = covered_of(truth);
    for (const double beside_rad : {-0.008, 0.0, 0.008}) {  // 5 px
        TurntableModel start = truth;
        start.pose.pan_rad += beside_rad;
        start.lens.f_px *= 1.02;
        const auto found = axis_from_silhouettes(covered, 1, start);
        ASSERT_TRUE(found);
        EXPECT_LT(std::abs(error_px(truth, *found)), 0.25) << beside_rad;
        EXPECT_LT(found->deviation_px, 0.3);
        EXPECT_GT(3 * found->deviation_px, std::abs(error_px(truth, *found)));
    }
}

TEST(SilhouetteSymmetry, FindsAnAxisThatLiesSideways) {
    TurntableModel truth = turn_of_silhouettes(36, 0.5 * kPi - 0.01);
    truth.pose.pan_rad = 0.01;
    std::swap(truth.lens.width, truth.lens.height);
    std::swap(truth.lens.cx, truth.lens.cy);
    TurntableModel start = truth;
    start.pose.pan_rad += 0.006;
    const auto found = axis_from_silhouettes(covered_of(truth), 1, start);
    ASSERT_TRUE(found);
    EXPECT_LT(std::abs(error_px(truth, *found)), 0.25);
}

TEST(SilhouetteSymmetry, CountsInPixelsOfThePhotographs) {
    const TurntableModel truth = turn_of_silhouettes(36);
    TurntableModel photos = truth;
    for (double* number : {&photos.lens.f_px, &photos.lens.cx, &photos.lens.cy}) *number *= 3;
    photos.lens.width *= 3;
    photos.lens.height *= 3;
    const auto found = axis_from_silhouettes(covered_of(truth), 3, photos);
    ASSERT_TRUE(found);
    EXPECT_LT(std::abs(error_px(photos, *found)), 0.75);
}

TEST(SilhouetteSymmetry, IsLessSureOfFewerViewsAndSilentWithoutAFullTurn) {
    const TurntableModel many = turn_of_silhouettes(36), few = turn_of_silhouettes(12);
    const auto of_many = axis_from_silhouettes(covered_of(many), 1, many);
    const auto of_few = axis_from_silhouettes(covered_of(few), 1, few);
    ASSERT_TRUE(of_many && of_few);
    EXPECT_GT(of_few->deviation_px, 3 * of_many->deviation_px);
    EXPECT_GT(3 * of_few->deviation_px, std::abs(error_px(few, *of_few)));
    TurntableModel part = many;
    part.angles_rad.resize(30);
    EXPECT_FALSE(axis_from_silhouettes(covered_of(part), 1, part));
}

TEST(SilhouetteSymmetry, DoesNotUseRowsCutOffByTheImage) {
    TurntableModel truth = turn_of_silhouettes(36);
    truth.pose.pan_rad = 0.235;  // the widest rows reach beyond the left border
    const Image<std::uint8_t> covered = covered_of(truth);
    int cut_off = 0;
    for (int y = 0; y < covered.height(); ++y) cut_off += covered(0, y) >= 128 ? 1 : 0;
    ASSERT_GT(cut_off, 10);
    const auto found = axis_from_silhouettes(covered, 1, truth);
    ASSERT_TRUE(found);
    EXPECT_LT(std::abs(error_px(truth, *found)), std::max(0.4, 2 * found->deviation_px));
}

// A strip missing on one side shifts the axis by half its width; tests the sign of the measurement.
TEST(SilhouetteSymmetry, FollowsMissingPartsOfMasks) {
    const TurntableModel truth = turn_of_silhouettes(36);
    const auto whole = axis_from_silhouettes(covered_of(truth), 1, truth);
    const auto lacking = axis_from_silhouettes(covered_of(truth, 4), 1, truth);
    ASSERT_TRUE(whole && lacking);
    EXPECT_NEAR(lacking->position_px - whole->position_px, 2, 0.4);
}

TEST(AgreedAxis, WeighsAgreementAndPrefersSilhouettesOtherwise) {
    const AxisPosition near = combine_axes({300, 100.0, 0.2}, {300, 100.2, 0.2});
    EXPECT_NEAR(near.position_px, 100.1, 1e-9);
    EXPECT_NEAR(near.deviation_px, 0.2 / std::sqrt(2.0), 1e-9);
    const AxisPosition apart = combine_axes({300, 102.0, 0.2}, {300, 100.0, 0.2});
    EXPECT_NEAR(apart.position_px, 100.0, 0.05);
    EXPECT_NEAR(apart.deviation_px, 0.2, 0.01);
    const AxisPosition unsure = combine_axes({300, 102.0, 0.2}, {300, 100.0, 2});
    EXPECT_NEAR(unsure.position_px, 102.0, 0.05);
}

TEST(AgreedAxis, IsReachedByThePanAlone) {
    const TurntableModel model = turn_of_silhouettes(36);
    const auto moved = move_axis_to(model, {200, 190, 0.1});
    ASSERT_TRUE(moved);
    EXPECT_NEAR(axis_position(moved->lens, moved->pose, 200).value(), 190, 1e-5);
    EXPECT_EQ(moved->pose.tilt_rad, model.pose.tilt_rad);
    EXPECT_EQ(moved->pose.roll_rad, model.pose.roll_rad);
    EXPECT_EQ(moved->lens.f_px, model.lens.f_px);
}

}  // namespace
}  // namespace rs::capture
