#include "rayspace/image_io/image_io.hpp"
#include "tests/support/small_disk.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

namespace {

namespace fs = std::filesystem;
using namespace rs;
using test::TemporaryFolder;
using testing::HasSubstr;

Image<Rgba8> noise(int width, int height, std::mt19937& random) {
    Image<Rgba8> image(width, height);
    for (Rgba8& p : image.pixels())
        p = {static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()), 7, 255};
    return image;
}

TEST(VideoWriter, AppearsWhenFinished) {
    const TemporaryFolder folder;
    {
        auto video = VideoWriter::open(folder / "a.mp4", 64, 48, 25);
        ASSERT_TRUE(video.ok()) << video.error().message;
        for (int i = 0; i < 10; ++i) {
            ASSERT_TRUE(video->add(Image<Rgba8>(64, 48, Rgba8{static_cast<std::uint8_t>(25 * i), 0, 0, 128})).ok());
        }
        EXPECT_FALSE(fs::exists(folder / "a.mp4"));
        const Status finished = video->finish();
        ASSERT_TRUE(finished.ok()) << finished.error().message;
    }
    EXPECT_GT(fs::file_size(folder / "a.mp4"), 500U);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(VideoWriter, DroppedItLeavesNothing) {
    const TemporaryFolder folder;
    {
        auto video = VideoWriter::open(folder / "a.mp4", 64, 48, 25);
        ASSERT_TRUE(video.ok());
        ASSERT_TRUE(video->add(Image<Rgba8>(64, 48)).ok());
    }
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(VideoWriter, RefusesWhatItCannotWrite) {
    const TemporaryFolder folder;
    EXPECT_THAT(VideoWriter::open(folder / "a.mp4", 63, 48, 25).error().message, HasSubstr("must be even"));
    EXPECT_THAT(VideoWriter::open(folder / "a.mp4", 64, 48, 0).error().message, HasSubstr("frame rate"));
    EXPECT_THAT(VideoWriter::open(folder.path() / "none" / "a.mp4", 64, 48, 25).error().message,
                HasSubstr("create it first"));
    EXPECT_THAT(VideoWriter::open(folder / "a.xyz", 64, 48, 25).error().message, HasSubstr(".mp4"));
    auto video = VideoWriter::open(folder / "a.mp4", 64, 48, 25);
    ASSERT_TRUE(video.ok());
    EXPECT_THAT(video->add(Image<Rgba8>(62, 48)).error().message, HasSubstr("62x48 pixels does not fit"));
}

TEST(VideoWriter, AVideoWithoutFramesIsAnError) {
    const TemporaryFolder folder;
    auto video = VideoWriter::open(folder / "a.mp4", 64, 48, 25);
    ASSERT_TRUE(video.ok());
    EXPECT_FALSE(video->finish().ok());
}

TEST(VideoWriter, AFullDiskIsAnErrorAndLeavesNothing) {
    const TemporaryFolder folder;
    const test::SmallDisk disk(folder.path(), 256);
    if (!disk.mounted()) GTEST_SKIP() << "a small file system cannot be mounted here (it takes root)";
    std::string message;
    {
        std::mt19937 random(1);
        auto video = VideoWriter::open(folder / "a.mp4", 320, 240, 25);
        if (video.ok()) {
            // The error is reported by the frame that does not fit, or by finish().
            Status status;
            for (int i = 0; i < 60 && status; ++i) status = video->add(noise(320, 240, random));
            if (status) status = video->finish();
            if (!status) message = status.error().message;
        }
    }
    const bool empty = fs::is_empty(folder.path());
    EXPECT_THAT(message, HasSubstr("no space left on device"));
    EXPECT_TRUE(empty);
}

}  // namespace
