#include "compositor/playback/sequence_player.hpp"

#include "tests/compositor/gl_test.hpp"
#include "tests/compositor/moving_boxes.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

namespace rs::compositor {
namespace {

using PlayerTest = test::GlTest;

const FrameOptions kSmall{.width = 160, .height = 96, .samples = 1};

Image<Rgba8> frame_of(SequencePlayer& player, std::size_t number) {
    auto frame = player.frame(number);
    EXPECT_TRUE(frame) << frame.error().message;
    return frame ? std::move(*frame) : Image<Rgba8>(1, 1);
}

bool same(const Image<Rgba8>& a, const Image<Rgba8>& b) {
    return a.width() == b.width() && a.height() == b.height() &&
           std::equal(a.pixels().begin(), a.pixels().end(), b.pixels().begin());
}

int differing(const Image<Rgba8>& a, const Image<Rgba8>& b) {
    int count = 0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) count += a(x, y) == b(x, y) ? 0 : 1;
    }
    return count;
}

TEST_F(PlayerTest, AFrameIsTheSameHoweverItIsComeByAndNothingIsUploadedAgain) {
    const auto sequence = test::moving_boxes(40, 3);
    auto player = SequencePlayer::create(sequence, {.frame = kSmall});
    ASSERT_TRUE(player) << player.error().message;
    const int uploads = player->compositor().uploads();
    EXPECT_GT(uploads, 0);
    const Image<Rgba8> first = frame_of(*player, 0);
    const Image<Rgba8> second = frame_of(*player, 1);
    EXPECT_GT(differing(first, second), 500);
    EXPECT_TRUE(same(frame_of(*player, 0), first));
    EXPECT_EQ(player->compositor().uploads(), uploads);

    auto fresh = SequencePlayer::create(sequence, {.frame = kSmall});
    ASSERT_TRUE(fresh);
    EXPECT_TRUE(same(frame_of(*fresh, 1), second));

    // Same frame as a static scene, whose lights are selected differently.
    Scene still = scene_at(*sequence, 1);
    for (GeometryNode& node : still.geometry) node.moving.reset();
    auto compositor = FrameCompositor::create(still, std::vector<PlacedObject>{}, kSmall);
    ASSERT_TRUE(compositor);
    const auto image = compositor->compose(camera_of(*sequence, 1, 160, 96));
    ASSERT_TRUE(image);
    int greatest = 0;
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 160; ++x) greatest = std::max(greatest, std::abs((*image)(x, y).r - second(x, y).r));
    }
    EXPECT_LE(greatest, 1);
}

TEST_F(PlayerTest, WeatherIsRepeatableByItsSeed) {
    const auto sequence = test::moving_boxes(3, 2);
    for (const char* word : {"rain", "snow"}) {
        SCOPED_TRACE(word);
        Weather weather = *parse_weather(word);
        auto player = SequencePlayer::create(sequence, {.frame = kSmall, .weather = weather});
        ASSERT_TRUE(player);
        const Image<Rgba8> first = frame_of(*player, 0);
        auto again = SequencePlayer::create(sequence, {.frame = kSmall, .weather = weather});
        ASSERT_TRUE(again);
        EXPECT_TRUE(same(frame_of(*again, 0), first));
        weather.seed = 2;
        auto other = SequencePlayer::create(sequence, {.frame = kSmall, .weather = weather});
        ASSERT_TRUE(other);
        EXPECT_GT(differing(frame_of(*other, 0), first), 200);
    }
}

// Particles behind a wall are hidden: half a metre behind the wall all of them are.
TEST_F(PlayerTest, WhatFallsIsHiddenByWhatIsBefore) {
    Scene scene;
    GeometryNode wall;
    wall.mesh = std::make_shared<const Mesh>(box_mesh({100, 100, 0.1}));
    scene.geometry.push_back(wall);
    const Camera camera = look_at_camera({0, 2, 0.45}, {0, 2, 0}, radians(60), 160, 96);
    const Camera far = look_at_camera({0, 2, 12}, {0, 2, 0}, radians(60), 160, 96);
    auto compositor = FrameCompositor::create(scene, std::vector<PlacedObject>{}, kSmall);
    ASSERT_TRUE(compositor);
    for (const char* word : {"rain", "snow"}) {
        compositor->set_weather(std::nullopt, 0);
        const Image<Rgba8> dry = *compositor->compose(camera);
        const Image<Rgba8> dry_far = *compositor->compose(far);
        compositor->set_weather(*parse_weather(word), 1.5);
        EXPECT_EQ(differing(*compositor->compose(camera), dry), 0) << word;
        EXPECT_GT(differing(*compositor->compose(far), dry_far), 200) << word;
    }
}

TEST_F(PlayerTest, TracedFramesMoveThingsWithoutNewTreesAndStandInFog) {
    const auto sequence = test::moving_boxes(12, 3);
    PlayerOptions options{.frame = kSmall, .tracing = TracedOptions{.method = TracedMethod::kWhitted}, .passes = 1};
    auto player = SequencePlayer::create(sequence, options);
    ASSERT_TRUE(player) << player.error().message;
    const Image<Rgba8> first = frame_of(*player, 0);
    const Image<Rgba8> second = frame_of(*player, 1);
    EXPECT_GT(differing(first, second), 500);
    EXPECT_TRUE(same(frame_of(*player, 0), first));
    EXPECT_EQ(player->tracers_made(), 1);
    auto fresh = SequencePlayer::create(sequence, options);
    ASSERT_TRUE(fresh);
    EXPECT_TRUE(same(frame_of(*fresh, 1), second));
    // Fog that ends before all geometry.
    options.weather = *parse_weather("fog");
    options.weather->visibility = 1.5;
    auto foggy = SequencePlayer::create(sequence, options);
    ASSERT_TRUE(foggy);
    const Image<Rgba8> nothing = frame_of(*foggy, 0);
    for (const Rgba8& pixel : nothing.pixels()) ASSERT_EQ(pixel, nothing(0, 0));
}

TEST_F(PlayerTest, AFixedCameraReplacesThoseOfTheSequence) {
    const auto sequence = test::moving_boxes(3, 2);
    const Camera above = look_at_camera({0, 12, 4}, {0, 0, 0}, radians(50), kSmall.width, kSmall.height);
    auto player = SequencePlayer::create(sequence, {.frame = kSmall, .camera = above});
    ASSERT_TRUE(player) << player.error().message;
    for (const std::size_t number : {0U, 1U}) {
        EXPECT_EQ(player->camera(number).world_from_camera, above.world_from_camera);
        const Image<Rgba8> frame = frame_of(*player, number);
        ASSERT_TRUE(player->draw(number, above));
        EXPECT_TRUE(same(player->compositor().image(), frame));
    }
}

TEST_F(PlayerTest, TimesCountTracingAndPasses) {
    const auto sequence = test::moving_boxes(3, 2);
    PlayerOptions options{.frame = kSmall, .tracing = TracedOptions{.method = TracedMethod::kWhitted}, .passes = 3};
    const auto times = [&] {
        auto player = SequencePlayer::create(sequence, options);
        EXPECT_TRUE(player) << player.error().message;
        frame_of(*player, 0);
        frame_of(*player, 1);
        return nlohmann::json::parse(player->times_as_json());
    };
    const nlohmann::json traced = times();
    EXPECT_EQ(traced["frames"], 2);
    EXPECT_EQ(traced["passes"], 6);
    EXPECT_GT(traced["median_parts_ms"]["tracing"], 0.0);
    EXPECT_GE(traced["median_ms"], traced["median_parts_ms"]["tracing"]);
    options.tracing.reset();
    const nlohmann::json raster = times();
    EXPECT_EQ(raster["passes"], 0);
    EXPECT_EQ(raster["median_parts_ms"]["tracing"], 0.0);
}

// Columns and rows of the pixels that differ.
glm::ivec2 extent_of_change(const Image<Rgba8>& a, const Image<Rgba8>& b) {
    glm::ivec2 lowest(a.width(), a.height()), highest(0);
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            if (a(x, y) == b(x, y)) continue;
            lowest = glm::min(lowest, glm::ivec2(x, y));
            highest = glm::max(highest, glm::ivec2(x, y));
        }
    }
    return highest - lowest + 1;
}

TEST_F(PlayerTest, AShutterBlursAlongTheMotionAndKeepsStillPartsBitForBit) {
    auto still = std::make_shared<Sequence>(*test::moving_boxes(1, 3));
    still->frames[1] = still->frames[0];
    auto moving = std::make_shared<Sequence>(*still);
    moving->frames[1].poses[0].pose.move.x -= 3;
    moving->frames[2].poses.clear();
    moving->frames[2].camera = moving->frames[0].camera;
    const std::optional<TracedOptions> kRaster;
    for (const auto& tracing : {kRaster, std::optional(TracedOptions{.method = TracedMethod::kWhitted}),
                                std::optional(TracedOptions{.method = TracedMethod::kToon})}) {
        const PlayerOptions sharp{.frame = kSmall, .tracing = tracing, .passes = 1};
        PlayerOptions blurred = sharp;
        blurred.shutter = 1;
        const auto frame = [&](const std::shared_ptr<const Sequence>& sequence, const PlayerOptions& options,
                               std::size_t number) {
            auto player = SequencePlayer::create(sequence, options);
            RS_CHECK(player.ok());
            return frame_of(*player, number);
        };
        EXPECT_TRUE(same(frame(still, blurred, 0), frame(still, sharp, 0)));
        const Image<Rgba8> empty = frame(moving, sharp, 2);
        EXPECT_TRUE(same(frame(moving, blurred, 2), empty));
        const glm::ivec2 box = extent_of_change(frame(moving, sharp, 0), empty);
        const glm::ivec2 streak = extent_of_change(frame(moving, blurred, 0), empty);
        EXPECT_GT(streak.x, box.x + 15);
        if (tracing) continue;  // traced boxes cast shadows
        EXPECT_LE(std::abs(streak.y - box.y), 3);
    }
}

TEST(CamerasOfASequence, GetAnotherFieldOfView) {
    auto sequence = *test::moving_boxes(3, 2);
    const Camera before = camera_of(sequence, 1, 160, 96);
    set_field_of_view(sequence, radians(30), 160.0 / 96);
    const Camera after = camera_of(sequence, 1, 160, 96);
    EXPECT_NEAR(after.fl_x, 80 / std::tan(radians(15)), 1e-9);
    EXPECT_EQ(after.world_from_camera, before.world_from_camera);
    // Without a camera, the scene is framed for the new field of view.
    for (SequenceFrame& frame : sequence.frames) frame.camera.reset();
    sequence.camera.reset();
    const Camera framing = camera_of(sequence, 1, 160, 96);
    set_field_of_view(sequence, radians(30), 160.0 / 96);
    const Camera narrow = camera_of(sequence, 1, 160, 96);
    EXPECT_NEAR(narrow.fl_x, 80 / std::tan(radians(15)), 1e-9);
    EXPECT_GT(narrow.centre().z, framing.centre().z);
}

TEST(WeatherWords, AreStrict) {
    for (const char* words : {"rain", "snow", "fog", "rain,fog", "snow,fog"}) {
        ASSERT_TRUE(parse_weather(words)) << words;
        EXPECT_EQ(weather_words(*parse_weather(words)), words);
    }
    EXPECT_EQ(weather_words(Weather{}), "none");
    for (const char* wrong : {"", "hail", "rain,", "rain,rain", "rain,snow", "Rain"}) {
        EXPECT_FALSE(parse_weather(wrong)) << wrong;
    }
}

TEST(WeatherOfAScene, IsDarkerByDayAndCoversWhatLooksUp) {
    Scene fair;
    fair.environment = EnvironmentLight{.pixels = std::make_shared<const Image<RgbaF>>(2, 1), .seen = true};
    const Scene rainy = apply_weather(fair, *parse_weather("rain"));
    EXPECT_FALSE(rainy.environment->seen) << "a clear sky";
    EXPECT_LT(rainy.lights[0].colour.x, fair.lights[0].colour.x);
    EXPECT_EQ(rainy.cover, Cover::kWet);
    ASSERT_TRUE(rainy.fog);
    const Scene foggy = apply_weather(fair, *parse_weather("fog"));
    EXPECT_LT(foggy.fog->visibility, rainy.fog->visibility);
    EXPECT_EQ(foggy.background.sky[0], foggy.fog->colour);
}

}  // namespace
}  // namespace rs::compositor
