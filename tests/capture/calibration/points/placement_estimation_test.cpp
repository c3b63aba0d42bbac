// Images of a turn that were shifted and scaled individually.

#include "capture/calibration/points/placement_estimation.hpp"

#include "capture/calibration/tracks/track_calibration.hpp"
#include "rayspace/base/conventions.hpp"
#include "tests/capture/calibration/drawn_drum.hpp"
#include "tests/capture/calibration/point_turns.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rs::capture {
namespace {

using testing::Contains;
using testing::HasSubstr;

// Random placements as from a shop's cropping.
std::vector<ImagePlacement> drawn_places(std::size_t views, double width) {
    std::vector<ImagePlacement> places;
    for (std::size_t i = 0; i < views; ++i) {
        const double t = 2 * kPi * static_cast<double>(i) / static_cast<double>(views);
        ImagePlacement place;
        place.shift_px = {width * (0.03 * std::sin(2 * t + 1) + (i % 3 == 1 ? 0.02 : 0)),
                          width * 0.02 * std::cos(3 * t)};
        place.scale = 1 + 0.06 * std::cos(2 * t) + (i % 2 == 1 ? 0.01 : 0);
        places.push_back(place);
    }
    return places;
}

glm::dvec2 middle_of(const Lens& lens) {
    return {lens.width / 2.0, lens.height / 2.0};
}

// Largest error of the estimated scales, except for a common factor.
double worst_scale(const std::vector<ImagePlacement>& found, const std::vector<ImagePlacement>& truth) {
    double mean = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) mean += std::log(found[i].scale / truth[i].scale);
    mean /= static_cast<double>(truth.size());
    double worst = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        worst = std::max(worst, std::abs(std::log(found[i].scale / truth[i].scale) - mean));
    }
    return worst;
}

TEST(ImagePlacement, IsUndoneAndChained) {
    const glm::dvec2 middle(320, 240), p(37, 401);
    const ImagePlacement outer{{12, -7}, 1.2}, inner{{-3, 5}, 0.9};
    EXPECT_LT(glm::distance(outer.undone(outer.seen(p, middle), middle), p), 1e-9);
    EXPECT_LT(glm::distance(outer.of(inner).seen(p, middle), outer.seen(inner.seen(p, middle), middle)), 1e-9);
    EXPECT_EQ(ImagePlacement{}.seen(p, middle), p);
}

TEST(ImagePlaces, AreFoundFromPointsInBothSenses) {
    for (const double sense : {1.0, -1.0}) {
        TurntableModel truth = test::turn_model(24, sense * radians(15));
        truth.lens.k1 = 0;
        const std::vector<ImagePlacement> places = drawn_places(24, truth.lens.width);
        std::vector<Track> tracks = test::tracks_of(truth, test::surface_points(250, 5), 0.2, 5);
        for (Track& track : tracks) {
            for (Observation& seen : track.seen) {
                seen.p = places[static_cast<std::size_t>(seen.view)].seen(seen.p, middle_of(truth.lens));
            }
        }
        Lens lens = truth.lens;
        lens.f_px = 0;
        const auto found = estimate_placements(tracks, lens, 24, 1, {});
        ASSERT_TRUE(found.has_value());
        EXPECT_GT(found->agreeing, 0.95);
        ASSERT_EQ(found->places.size(), 24U);
        EXPECT_LT(worst_scale(found->places, places), 0.01);
        EXPECT_GT(found->model.angles_rad[1] * sense, 0) << "turns the other way";
        EXPECT_NEAR(degrees(found->model.angles_rad[23]), sense * 345, 2);
        EXPECT_NEAR(degrees(found->model.pose.tilt_rad), 20, 3);
    }
}

TEST(ImagePlaces, AImageIsPutBack) {
    const ImagePlacement place{{9, -4}, 1.25};
    TurnImages turn;
    turn.width = 160;
    turn.height = 120;
    turn.reduction = 2;
    // A spot at (40, 50) of the reduced image, transformed by the placement.
    const glm::dvec2 spot = ImagePlacement{place.shift_px / 2.0, place.scale}.seen({40, 50}, {40, 30});
    CalibrationImage image{Image<std::uint8_t>(80, 60, 0), Image<std::uint8_t>(80, 60, 255)};
    for (int y = 0; y < 60; ++y) {
        for (int x = 0; x < 80; ++x) {
            const double apart = glm::distance(glm::dvec2(x + 0.5, y + 0.5), spot);
            image.grey(x, y) = static_cast<std::uint8_t>(std::lround(200 * std::exp(-apart * apart / 8)));
        }
    }
    turn.images.push_back(image);
    const TurnImages back = undo_placements(turn, std::vector<ImagePlacement>{place});
    glm::dvec2 sum(0.0);
    double weight = 0;
    for (int y = 0; y < 60; ++y) {
        for (int x = 0; x < 80; ++x) {
            const double grey = back.images[0].grey(x, y);
            sum += grey * glm::dvec2(x + 0.5, y + 0.5);
            weight += grey;
        }
    }
    EXPECT_LT(glm::distance(sum / weight, glm::dvec2(40, 50)), 0.05);
    EXPECT_EQ(back.images[0].alpha(40, 30), 255);
    EXPECT_EQ(back.images[0].alpha(0, 59), 0) << "an enlarged image does not cover this corner";
}

TEST(ImagePlaces, ATurnOfMovedImagesIsCalibrated) {
    const TurntableModel truth = test::drum_turn(24, -radians(15));
    const std::vector<ImagePlacement> places = drawn_places(24, truth.lens.width);
    TurnImages turn;
    turn.width = truth.lens.width;
    turn.height = truth.lens.height;
    turn.names = test::photograph_names(24);
    std::vector<ImagePlacement> inverse;
    for (std::size_t i = 0; i < 24; ++i) {
        turn.images.push_back(calibration_image(test::drawn_drum({}, truth, i), 1));
        inverse.push_back({-places[i].shift_px / places[i].scale, 1 / places[i].scale});
    }
    const auto still = calibrate_with_tracks(turn, {}, nullptr);
    ASSERT_TRUE(still.ok()) << still.error().message;
    EXPECT_TRUE(still->calibration.places.empty());

    const auto found = calibrate_with_tracks(undo_placements(turn, inverse), {}, nullptr);
    ASSERT_TRUE(found.ok()) << found.error().message;
    const Calibration& calibration = found->calibration;
    ASSERT_EQ(calibration.places.size(), 24U);
    EXPECT_LT(worst_scale(calibration.places, places), 0.01);
    EXPECT_LT(calibration.rms_px, 0.5);
    EXPECT_NEAR(degrees(calibration.step_rad), -15, 0.3);
    EXPECT_THAT(calibration.warnings, Contains(HasSubstr("moved (by up to ")));
}

}  // namespace
}  // namespace rs::capture
