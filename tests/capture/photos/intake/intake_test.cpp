#include "capture/photos/intake/intake.hpp"

#include "rayspace/image_io/image_io.hpp"
#include "tests/capture/photos/turn_of_images.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

namespace rs::capture {
namespace {

TEST(Intake, ReportsIgnoredFiles) {
    const test::TemporaryFolder folder;
    for (int i = 1; i <= 5; ++i) {
        const auto code = static_cast<std::uint8_t>(40 * i);
        const Image<Rgba8> image(64, 48, Rgba8{code, 90, 90, 255});
        ASSERT_TRUE(write_jpeg(folder / (std::to_string(i) + ".jpg"), image, 90).ok());
        if (i > 3) continue;
        ASSERT_TRUE(write_png(folder / (std::to_string(i) + ".png"), image).ok());
    }
    std::ofstream(folder / "1.cr2") << "raw";
    Result<PhotoFolder> found = open_photo_folder(folder.path());
    ASSERT_TRUE(found.ok()) << found.error().message;
    const Result<Intake> taken = run_intake(std::move(*found), nullptr);
    ASSERT_TRUE(taken.ok()) << taken.error().message;
    EXPECT_THAT(taken->notes, testing::ElementsAre("ignored, not an image: 1.cr2",
                                                   "ignored, present in another format, too: 1.png and 2 more"));
}

// Camera noise, different for every shot.
Image<Rgba8> noisy(const Image<Rgba8>& photo, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> noise(-3, 3);
    Image<Rgba8> result = photo;
    for (Rgba8& p : result.pixels()) {
        p.r = static_cast<std::uint8_t>(std::clamp(p.r + noise(random), 0, 255));
        p.g = static_cast<std::uint8_t>(std::clamp(p.g + noise(random), 0, 255));
        p.b = static_cast<std::uint8_t>(std::clamp(p.b + noise(random), 0, 255));
    }
    return result;
}

std::vector<Image<Rgba8>> noisy_turn(const test::DrawnTurn& turn) {
    std::vector<Image<Rgba8>> photos = test::draw_photos(turn);
    for (std::size_t i = 0; i < photos.size(); ++i) photos[i] = noisy(photos[i], static_cast<unsigned>(i));
    return photos;
}

TEST(Repeat, DetectsASecondShotOfTheFirstView) {
    std::vector<Image<Rgba8>> photos = noisy_turn({});
    photos.push_back(noisy(test::draw_view({}, 0).photo, 99));
    EXPECT_TRUE(detect_repeat(photos).last_repeats_first);
}

TEST(Repeat, AcceptsAClosedTurn) {
    EXPECT_FALSE(detect_repeat(noisy_turn({})).last_repeats_first);
    test::DrawnTurn dense;
    dense.views = 72;
    EXPECT_FALSE(detect_repeat(noisy_turn(dense)).last_repeats_first);
}

TEST(Repeat, IgnoresUnchangingObjects) {
    std::vector<Image<Rgba8>> vase;
    for (unsigned i = 0; i < 8; ++i) vase.push_back(noisy(test::draw_view({}, 0).photo, i));
    EXPECT_FALSE(detect_repeat(vase).last_repeats_first);
}

TEST(Repeat, RequiresFourPhotos) {
    const Image<Rgba8> same = test::draw_view({}, 0).photo;
    const std::vector<Image<Rgba8>> three = {same, test::draw_view({}, 3).photo, same};
    EXPECT_FALSE(detect_repeat(three).last_repeats_first);
    const std::vector<Image<Rgba8>> four = {same, test::draw_view({}, 3).photo, test::draw_view({}, 8).photo, same};
    EXPECT_TRUE(detect_repeat(four).last_repeats_first);
}

TEST(Repeat, DifferenceIncludesAlphaAndIgnoresHiddenColour) {
    const Image<Rgba8> clear(2, 1, Rgba8{200, 100, 50, 0});
    const Image<Rgba8> black(2, 1, Rgba8{0, 0, 0, 0});
    const Image<Rgba8> solid(2, 1, Rgba8{0, 0, 0, 255});
    EXPECT_EQ(mean_difference(clear, black), 0);
    EXPECT_EQ(mean_difference(black, solid), 255 / 4.0);
}

}  // namespace
}  // namespace rs::capture
