// Frame selection on synthetic videos with known angles.

#include "capture/photos/intake/video/frame_selection.hpp"

#include "tests/capture/photos/intake/turning_ellipsoid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace rs::capture {
namespace {

// Synthetic video with the angle of each frame.
struct Film {
    std::vector<double> angles_deg;
    std::vector<FrameCopy> copies;
};

Film make_film(
    std::size_t frames, const std::function<double(std::size_t)>& angle_deg,
    const std::function<test::TurningEllipsoid(std::size_t)>& look = [](std::size_t) {
        return test::TurningEllipsoid();
    }) {
    Film video;
    for (std::size_t i = 0; i < frames; ++i) {
        video.angles_deg.push_back(angle_deg(i));
        video.copies.push_back(make_frame_copy(test::film_frame(look(i), radians(video.angles_deg.back()))));
    }
    return video;
}

std::vector<double> gaps_deg(const Film& video, const FrameSelection& selection) {
    std::vector<double> gaps;
    for (std::size_t k = 1; k < selection.frames.size(); ++k) {
        gaps.push_back(video.angles_deg[selection.frames[k]] - video.angles_deg[selection.frames[k - 1]]);
    }
    return gaps;
}

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

double relative_deviation(const std::vector<double>& values) {
    const double m = mean(values);
    double squares = 0;
    for (const double value : values) squares += (value - m) * (value - m);
    return std::sqrt(squares / static_cast<double>(values.size())) / m;
}

double turn_deg(const Film& video, const TurnRange& turn) {
    return video.angles_deg[turn.end] - video.angles_deg[turn.begin];
}

TEST(FrameSelection, SelectsOneTurnEvenly) {
    Film video = make_film(300, [](std::size_t i) { return 1.5 * static_cast<double>(i); });
    const FrameSelection selection = select_frames(video.copies, {}, nullptr);
    ASSERT_TRUE(selection.turn.is_closed);
    EXPECT_TRUE(selection.is_speed_measured);
    EXPECT_NEAR(turn_deg(video, selection.turn), 360, 1.5);
    EXPECT_GE(selection.frames.size(), 66U);
    EXPECT_LE(selection.frames.size(), 72U);
    EXPECT_LT(relative_deviation(gaps_deg(video, selection)), 0.25);
}

TEST(FrameSelection, SelectsTheRequestedCount) {
    Film video = make_film(320, [](std::size_t i) { return 1.25 * static_cast<double>(i); });
    const FrameSelection selection = select_frames(video.copies, {48, false}, nullptr);
    EXPECT_EQ(selection.frames.size(), 48U);
    EXPECT_LT(relative_deviation(gaps_deg(video, selection)), 0.2);
}

TEST(FrameSelection, FollowsATurntableThatSpeedsUp) {
    // Three times as fast at the end.
    Film video = make_film(400, [](std::size_t i) {
        const double t = static_cast<double>(i) / 399;
        return 400 * (t + t * t) / 2;
    });
    const FrameSelection selection = select_frames(video.copies, {}, nullptr);
    ASSERT_TRUE(selection.turn.is_closed);
    EXPECT_NEAR(turn_deg(video, selection.turn), 360, 1.5);
    EXPECT_TRUE(selection.is_speed_measured);
    const std::vector<double> gaps = gaps_deg(video, selection);
    EXPECT_LT(relative_deviation(gaps), 0.25);
    const std::vector<double> first(gaps.begin(), gaps.begin() + 20), last(gaps.end() - 20, gaps.end());
    EXPECT_NEAR(mean(last) / mean(first), 1, 0.2);
}

TEST(FrameSelection, FollowsTheTrendWhereTheCameraIsLevel) {
    const auto look = [](std::size_t) {
        test::TurningEllipsoid level;
        level.elevation_rad = 0;
        level.radii = {40, 40, 40};
        return level;
    };
    Film video = make_film(
        300,
        [](std::size_t i) {
            const double t = static_cast<double>(i) / 299;
            return 400 * (t + t * t / 2) / 1.5;
        },
        look);
    const FrameSelection selection = select_frames(video.copies, {}, nullptr);
    ASSERT_TRUE(selection.turn.is_closed);
    EXPECT_FALSE(selection.is_speed_measured);
    const std::vector<double> gaps = gaps_deg(video, selection);
    const std::vector<double> first(gaps.begin(), gaps.begin() + 20), last(gaps.end() - 20, gaps.end());
    EXPECT_NEAR(mean(last) / mean(first), 1, 0.25);
}

TEST(FrameSelection, RemovesFramesWithoutRotation) {
    // Pauses for 60 frames, turns by 420 degrees in 280, and pauses again.
    Film video = make_film(
        400, [](std::size_t i) { return 1.5 * static_cast<double>(std::clamp<std::size_t>(i, 60, 340) - 60); });
    const FrameSelection selection = select_frames(video.copies, {}, nullptr);
    ASSERT_TRUE(selection.turn.is_closed);
    EXPECT_GE(selection.turn.begin, 57U);
    EXPECT_NEAR(turn_deg(video, selection.turn), 360, 1.5);
}

TEST(FrameSelection, KeepsOneOfTwoTurns) {
    Film video = make_film(500, [](std::size_t i) { return 10 + 1.6 * static_cast<double>(i); });
    const FrameSelection selection = select_frames(video.copies, {}, nullptr);
    ASSERT_TRUE(selection.turn.is_closed);
    EXPECT_NEAR(turn_deg(video, selection.turn), 360, 1.6);
}

TEST(FrameSelection, SelectsAllOfAPartialTurn) {
    Film video = make_film(250, [](std::size_t i) { return 1.2 * static_cast<double>(i); });
    const FrameSelection selection = select_frames(video.copies, {60, false}, nullptr);
    EXPECT_FALSE(selection.turn.is_closed);
    EXPECT_LE(selection.turn.begin, 4U);
    EXPECT_GE(selection.turn.end, 246U);
    EXPECT_EQ(selection.frames.size(), 60U);
    EXPECT_LT(relative_deviation(gaps_deg(video, selection)), 0.25);
}

TEST(FrameSelection, PrefersSharpFrames) {
    const auto is_sharp = [](std::size_t i) { return i % 3 == 1; };
    Film video = make_film(
        280, [](std::size_t i) { return 1.5 * static_cast<double>(i); },
        [&](std::size_t i) {
            test::TurningEllipsoid look;
            look.blur_rad = is_sharp(i) ? 0 : radians(5);
            return look;
        });
    const FrameSelection selection = select_frames(video.copies, {}, nullptr);
    const auto sharp = std::ranges::count_if(selection.frames, is_sharp);
    EXPECT_GE(static_cast<double>(sharp), 0.95 * static_cast<double>(selection.frames.size()));
    EXPECT_GE(selection.frames.size(), 36U);
}

TEST(FrameSelection, SkipsStepsWithBlurredFramesUnlessACountIsGiven) {
    // Sharp only every 10 degrees.
    const auto look = [](std::size_t i) {
        test::TurningEllipsoid video;
        video.blur_rad = i % 10 == 0 ? 0 : radians(6);
        return video;
    };
    const auto angle = [](std::size_t i) { return static_cast<double>(i); };
    Film video = make_film(380, angle, look);
    const FrameSelection free = select_frames(video.copies, {}, nullptr);
    EXPECT_NEAR(static_cast<double>(free.frames.size()), 36, 3);
    const FrameSelection exact = select_frames(video.copies, {72, false}, nullptr);
    EXPECT_EQ(exact.frames.size(), 72U);
}

TEST(FrameSelection, IgnoresExposureChanges) {
    const auto look = [](std::size_t i) {
        test::TurningEllipsoid video;
        video.exposure = 1 + 0.2 * std::sin(0.05 * static_cast<double>(i));
        return video;
    };
    Film video = make_film(
        300, [](std::size_t i) { return 1.4 * static_cast<double>(i); }, look);
    const FrameSelection selection = select_frames(video.copies, {}, nullptr);
    ASSERT_TRUE(selection.turn.is_closed);
    EXPECT_NEAR(turn_deg(video, selection.turn), 360, 1.5);
    EXPECT_LT(relative_deviation(gaps_deg(video, selection)), 0.25);
}

TEST(FrameSelection, AcceptsFewFrames) {
    for (const std::size_t count : {1U, 2U, 3U, 7U, 12U}) {
        Film video = make_film(count, [](std::size_t i) { return 20 * static_cast<double>(i); });
        const FrameSelection selection = select_frames(video.copies, {}, nullptr);
        EXPECT_LE(selection.frames.size(), count);
        EXPECT_GE(selection.frames.size(), (count + 1) / 2);
        EXPECT_TRUE(std::ranges::is_sorted(selection.frames));
    }
}

TEST(FrameSelection, AcceptsAFilmWithoutMotion) {
    Film video = make_film(40, [](std::size_t) { return 0.0; });
    const FrameSelection selection = select_frames(video.copies, {}, nullptr);
    EXPECT_FALSE(selection.turn.is_closed);
    EXPECT_EQ(std::ranges::count(selection.moving.pixels(), 0), std::ssize(selection.moving.pixels()));
}

TEST(FrameSelection, NoteStatesTheSelection) {
    FrameSelection selection;
    selection.frames = {11, 20, 30};
    selection.turn = {11, 287, true};
    EXPECT_EQ(selection_note("turn.mp4", "frames", 300, selection),
              "turn.mp4: 300 frames, one turn is frames 12..287, 3 chosen");
    selection.turn.is_closed = false;
    EXPECT_EQ(selection_note("turn.mp4", "frames", 300, selection),
              "turn.mp4: 300 frames, of which 12..287 turn and none repeats the first, 3 chosen");
}

}  // namespace
}  // namespace rs::capture
