// Tracking of points in synthetic images with ground truth, and the calibration based on them.

#include "capture/calibration/points/tracks.hpp"

#include "capture/calibration/points/bundle.hpp"
#include "capture/calibration/tracks/track_calibration.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/median.hpp"
#include "tests/capture/calibration/drawn_drum.hpp"
#include "tests/capture/calibration/point_turns.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

using testing::Contains;
using testing::HasSubstr;

TurnImages images_of(const TurntableModel& model, const test::Drum& drum = {}) {
    TurnImages turn;
    turn.width = model.lens.width;
    turn.height = model.lens.height;
    turn.names = test::photograph_names(model.angles_rad.size());
    for (std::size_t i = 0; i < model.angles_rad.size(); ++i) {
        turn.images.push_back(calibration_image(test::drawn_drum(drum, model, i), 1));
    }
    return turn;
}

// Restricts the start search in tests of other features.
KnownInputs lens_and_sense() {
    KnownInputs known;
    known.f_px = 620;
    known.counter_clockwise = false;
    return known;
}

TurntableModel truth() {
    return test::drum_turn(24, -radians(15));
}

const TurnImages& drum_images() {
    static const TurnImages kImages = images_of(truth());
    return kImages;
}

// Median over tracks of the residual of the best point under the true model.
double median_miss_px(const std::vector<Track>& tracks) {
    std::vector<double> misses;
    for (const Track& track : tracks) {
        const Bundle bundle = make_bundle(truth(), std::vector<Track>{track});
        misses.push_back(bundle.tracks.empty() ? 1e9 : rms_px(bundle));
    }
    return median(std::move(misses));
}

void expect_well_formed(const std::vector<Track>& tracks, int views) {
    for (const Track& track : tracks) {
        ASSERT_GE(track.seen.size(), 3U);
        for (std::size_t i = 0; i < track.seen.size(); ++i) {
            ASSERT_GE(track.seen[i].view, i == 0 ? 0 : track.seen[i - 1].view + 1);
            ASSERT_LT(track.seen[i].view, views);
        }
    }
}

TEST(Tracks, FollowPointsOfADrum) {
    const TurnImages& turn = drum_images();
    const auto tracker = PointTracker::detect(turn.images, 1, {}, nullptr);
    ASSERT_TRUE(tracker.ok()) << tracker.error().message;
    const auto found = tracker->track(nullptr);
    ASSERT_TRUE(found.ok()) << found.error().message;
    ASSERT_GT(found->tracks.size(), 100U);
    expect_well_formed(found->tracks, 24);
    EXPECT_LT(median_miss_px(found->tracks), 0.6);
    ASSERT_EQ(found->features.size(), 24U);
    EXPECT_GT(*std::min_element(found->features.begin(), found->features.end()), 60);
    bool closes = false;
    for (const MatchedPair& pair : found->pairs) {
        if (pair.matches == 0) continue;
        EXPECT_GT(pair.spread_x_px, pair.spread_y_px) << pair.first << " " << pair.second;
        const int apart = (pair.second - pair.first + 24) % 24;
        if (apart <= 2) {  // clockwise: the front moves to the left
            EXPECT_LT(pair.motion_x_px, 0) << pair.first << " " << pair.second;
        }
        closes = closes || (pair.first == 23 && pair.second == 0) || (pair.first == 0 && pair.second == 23);
    }
    EXPECT_TRUE(closes) << "the last view is next to the first";

    const auto guided = tracker->track_guided(truth(), 0.15, 2);
    ASSERT_TRUE(guided.ok()) << guided.error().message;
    expect_well_formed(*guided, 24);
    const auto right = [](const std::vector<Track>& tracks) {
        return observation_count(make_robust_bundle(truth(), tracks, 1.5));
    };
    EXPECT_GT(right(*guided), right(found->tracks));
}

TEST(Tracks, PositionsAreInPixelsOfThePhotographs) {
    const TurnImages& turn = drum_images();
    const std::vector<CalibrationImage> few(turn.images.begin(), turn.images.begin() + 6);
    const auto whole = PointTracker::detect(few, 1, {}, nullptr);
    const auto reduced = PointTracker::detect(few, 3, {}, nullptr);
    ASSERT_TRUE(whole.ok() && reduced.ok());
    const auto a = whole->track(nullptr), b = reduced->track(nullptr);
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_EQ(a->features, b->features);
    ASSERT_FALSE(b->tracks.empty());
    double farthest_right_px = 0;
    for (const Track& track : b->tracks) {
        for (const Observation& seen : track.seen) {
            const glm::dvec2 p = seen.p / 3.0;
            ASSERT_GT(few[static_cast<std::size_t>(seen.view)].alpha(static_cast<int>(p.x), static_cast<int>(p.y)),
                      250);
            farthest_right_px = std::max(farthest_right_px, seen.p.x);
        }
    }
    EXPECT_GT(farthest_right_px, 320);
}

TEST(Tracks, DoNotDependOnTheNumberOfThreads) {
    const TurnImages& turn = drum_images();
    const std::vector<CalibrationImage> few(turn.images.begin(), turn.images.begin() + 8);
    const auto track_with = [&](int threads) {
        tbb::task_arena arena(threads);
        return arena.execute([&] { return PointTracker::detect(few, 1, {}, nullptr)->track(nullptr)->tracks; });
    };
    const auto one = track_with(1), two = track_with(2);
    ASSERT_EQ(one.size(), two.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
        ASSERT_EQ(one[i].seen.size(), two[i].seen.size());
        for (std::size_t k = 0; k < one[i].seen.size(); ++k) {
            EXPECT_EQ(one[i].seen[k].view, two[i].seen[k].view);
            EXPECT_EQ(one[i].seen[k].p, two[i].seen[k].p);
        }
    }
}

TEST(Tracks, NothingIsLookedForOnTheBackdrop) {
    TurnImages turn = drum_images();
    turn.images.resize(6);
    for (CalibrationImage& image : turn.images) {  // a texture outside the object
        for (int y = 0; y < 256; ++y) {
            for (int x = 0; x < 320; ++x) {
                if (image.alpha(x, y) == 0) image.grey(x, y) = (x / 16 + y / 16) % 2 == 0 ? 110 : 140;
            }
        }
    }
    const auto found = PointTracker::detect(turn.images, 1, {}, nullptr)->track(nullptr);
    ASSERT_TRUE(found.ok());
    ASSERT_FALSE(found->tracks.empty());
    for (const Track& track : found->tracks) {
        for (const Observation& seen : track.seen) {
            const CalibrationImage& image = turn.images[static_cast<std::size_t>(seen.view)];
            EXPECT_GT(image.alpha(static_cast<int>(seen.p.x), static_cast<int>(seen.p.y)), 250);
        }
    }
}

TEST(Tracks, CalibrationImagesAreMeans) {
    Image<Rgba8> image(5, 4, {100, 100, 100, 255});
    image(0, 0) = {200, 200, 200, 255};
    image(2, 0).a = 1;
    const CalibrationImage half = calibration_image(image, 2);
    EXPECT_EQ(half.grey.width(), 2);
    EXPECT_EQ(half.grey.height(), 2);
    EXPECT_EQ(half.grey(0, 0), 125);
    EXPECT_EQ(half.grey(1, 1), 100);
    EXPECT_EQ(half.alpha(0, 0), 255);
    EXPECT_NEAR(half.alpha(1, 0), (3 * 255 + 1) / 4, 1);
}

TEST(TrackCalibration, FindsTheTurnOfADrum) {
    KnownInputs sense;
    sense.counter_clockwise = false;
    const auto found = calibrate_with_tracks(drum_images(), sense, nullptr);
    ASSERT_TRUE(found.ok()) << found.error().message;
    const Calibration& calibration = found->calibration;
    const TurntableModel expected = truth();
    EXPECT_EQ(calibration.method, CalibrationMethod::kTracks);
    EXPECT_NEAR(calibration.model.lens.f_px, expected.lens.f_px, 0.03 * expected.lens.f_px);
    EXPECT_NEAR(degrees(calibration.model.pose.tilt_rad), 20, 0.5);
    EXPECT_NEAR(degrees(calibration.model.pose.roll_rad), degrees(expected.pose.roll_rad), 0.1);
    const auto axis = axis_column(calibration.model.lens, calibration.model.pose, 128);
    ASSERT_TRUE(axis.has_value());
    EXPECT_NEAR(*axis, *axis_column(expected.lens, expected.pose, 128), 0.3);
    for (std::size_t i = 0; i < 24; ++i) {
        EXPECT_NEAR(degrees(calibration.model.angles_rad[i]), degrees(expected.angles_rad[i]), 0.2) << i;
    }
    EXPECT_LT(calibration.rms_px, 0.3);
    ASSERT_TRUE(calibration.held_out_rms_px.has_value());
    EXPECT_LT(*calibration.held_out_rms_px, 0.5);
    EXPECT_GT(*calibration.held_out_rms_px, 0);
    EXPECT_TRUE(calibration.warnings.empty()) << calibration.warnings[0];
    // The deviations cover the errors.
    EXPECT_LT(std::abs(calibration.model.lens.f_px - expected.lens.f_px), 4 * calibration.deviations.f_px);
    EXPECT_LT(calibration.deviations.f_px, 0.05 * expected.lens.f_px);
}

// The best lens folds the image corners over: another effect than distortion causes the deviations.
TEST(TrackCalibration, TakesNoLensThatFoldsItsImage) {
    TurntableModel bent = truth();
    bent.lens.k1 = -3;
    ASSERT_FALSE(undistorted(bent.lens, {0, 0}).has_value());
    const auto found = calibrate_with_tracks(images_of(bent), lens_and_sense(), nullptr);
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_EQ(found->calibration.model.lens.k1, 0);
    EXPECT_THAT(found->calibration.warnings, Contains(HasSubstr("do not determine the lens distortion")));
}

TEST(TrackCalibration, NamesTheViewsThatStandWrongOrAreBlurred) {
    TurntableModel model = truth();
    model.angles_rad[9] += radians(1.8);
    TurnImages turn = images_of(model);
    Image<std::uint8_t>& grey = turn.images[17].grey;
    cv::Mat wrapped(grey.height(), grey.width(), CV_8U, &grey(0, 0), static_cast<std::size_t>(grey.view().stride()));
    cv::GaussianBlur(wrapped, wrapped, {}, 7);
    const auto found = calibrate_with_tracks(turn, lens_and_sense(), nullptr);
    ASSERT_TRUE(found.ok()) << found.error().message;
    const auto& warnings = found->calibration.warnings;
    EXPECT_THAT(warnings, Contains(HasSubstr("009.jpg is 1.8 degrees off (not far enough)")));
    EXPECT_THAT(warnings, Contains(AllOf(HasSubstr("017.jpg"), HasSubstr("is it blurred?"))));
}

TEST(TrackCalibration, SaysWhatIsWrongWithImagesThatMakeNoTurn) {
    const auto message = [](const TurnImages& turn) {
        const auto found = calibrate_with_tracks(turn, lens_and_sense(), nullptr);
        EXPECT_FALSE(found.ok());
        return found.ok() ? "" : found.error().message;
    };
    TurnImages few = drum_images();
    few.images.resize(3);
    few.names.resize(3);
    EXPECT_THAT(message(few), HasSubstr("take at least 5"));

    test::Drum plain;
    plain.is_spotted = false;
    EXPECT_THAT(message(images_of(truth(), plain)), HasSubstr("needs a board under it (rs-capture board)"));
}

}  // namespace
}  // namespace rs::capture
