// VideoReader on files from VideoWriter, files from other encoders (tests/fuzz/corpus/film), and damaged files.

#include "rayspace/image_io/video_reader.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace rs {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;

constexpr int kFrames = 30;

// Frame i shows a bright bar at column 2 i.
fs::path write_film(const test::TemporaryFolder& folder) {
    const fs::path path = folder / "film.mp4";
    Result<VideoWriter> video = VideoWriter::open(path, 64, 48, 10);
    EXPECT_TRUE(video.ok());
    for (int i = 0; i < kFrames; ++i) {
        Image<Rgba8> frame(64, 48, {30, 60, 90, 255});
        for (int y = 0; y < 48; ++y) {
            for (int x = 2 * i; x < 2 * i + 4 && x < 64; ++x) frame(x, y) = {240, 200, 20, 255};
        }
        EXPECT_TRUE(video->add(frame).ok());
    }
    EXPECT_TRUE(video->finish().ok());
    return path;
}

struct Reading {
    std::vector<Image<Rgba8>> frames;
    VideoInfo info;
    std::string error;  // empty on success
};

Reading read_all(const fs::path& path) {
    Reading reading;
    Result<VideoReader> reader = VideoReader::open(path);
    if (!reader) {
        reading.error = reader.error().message;
        return reading;
    }
    reading.info = reader->info();
    Image<Rgba8> frame;
    for (;;) {
        const Result<bool> has_frame = reader->read(frame);
        if (!has_frame) reading.error = has_frame.error().message;
        if (!has_frame || !*has_frame) return reading;
        reading.frames.push_back(frame);
    }
}

void expect_near(const Rgba8& is, const Rgba8& wanted, int codes) {
    EXPECT_NEAR(is.r, wanted.r, codes);
    EXPECT_NEAR(is.g, wanted.g, codes);
    EXPECT_NEAR(is.b, wanted.b, codes);
    EXPECT_EQ(is.a, 255);
}

std::vector<std::byte> bytes_of(const fs::path& path) {
    return *read_file(path, 1 << 24);
}

void write_bytes(const fs::path& path, std::span<const std::byte> bytes) {
    ASSERT_TRUE(write_file(path, bytes).ok());
}

TEST(VideoReader, ReadsFilesFromVideoWriter) {
    const test::TemporaryFolder folder;
    const Reading reading = read_all(write_film(folder));
    EXPECT_EQ(reading.error, "");
    ASSERT_EQ(reading.frames.size(), static_cast<std::size_t>(kFrames));
    EXPECT_EQ(reading.info.width, 64);
    EXPECT_EQ(reading.info.height, 48);
    EXPECT_EQ(reading.info.orientation, 1);
    EXPECT_NEAR(reading.info.frames_per_second, 10, 1e-6);
    EXPECT_EQ(reading.info.frame_estimate, kFrames);
    EXPECT_FALSE(reading.info.is_hdr);
    for (int i = 2; i < kFrames - 1; ++i) {
        const Image<Rgba8>& frame = reading.frames[static_cast<std::size_t>(i)];
        expect_near(frame(2 * i - 4, 20), {30, 60, 90, 255}, 12);
        EXPECT_GT(frame(2 * i + 1, 20).r, 180) << i;
    }
}

// Colours of the corpus files: 0x2050D0 to the left of column 16, 0xC06030 to the right.
TEST(VideoReader, ConvertsDepthsRangesAndMatrices) {
    const fs::path corpus = fs::path(RAYSPACE_SOURCE_DIR) / "tests" / "fuzz" / "corpus" / "film";
    for (const char* name : {"ten-bit.mp4", "full-range.mkv", "no-matrix.avi", "wide-pixels.ts", "on-its-side.mp4"}) {
        SCOPED_TRACE(name);
        const Reading reading = read_all(corpus / name);
        EXPECT_EQ(reading.error, "");
        ASSERT_FALSE(reading.frames.empty());
        const Image<Rgba8>& frame = reading.frames.back();
        expect_near(frame(4, 12), {0x20, 0x50, 0xD0, 255}, 6);
        expect_near(frame(frame.width() - 6, 12), {0xC0, 0x60, 0x30, 255}, 6);
    }
}

TEST(VideoReader, MakesPixelsSquareAndStatesTheOrientation) {
    const fs::path corpus = fs::path(RAYSPACE_SOURCE_DIR) / "tests" / "fuzz" / "corpus" / "film";
    const Reading wide = read_all(corpus / "wide-pixels.ts");  // 64x32 of pixels 2:3
    EXPECT_EQ(wide.info.width, 43);
    EXPECT_EQ(wide.info.height, 32);
    EXPECT_EQ(read_all(corpus / "on-its-side.mp4").info.orientation, 8);  // turned by 90 degrees counter-clockwise
}

TEST(VideoReader, RejectsFilesThatAreNoVideo) {
    const test::TemporaryFolder folder;
    EXPECT_THAT(read_all(folder / "none.mp4").error, HasSubstr("none.mp4"));
    write_bytes(folder / "text.mp4", std::as_bytes(std::span("this is no film at all", 22)));
    EXPECT_THAT(read_all(folder / "text.mp4").error, HasSubstr("cannot be read as a video"));
    write_bytes(folder / "empty.mp4", {});
    EXPECT_THAT(read_all(folder / "empty.mp4").error, HasSubstr("cannot be read as a video"));
    // A playlist must not open other files.
    const std::string playlist =
        "#EXTM3U\n#EXT-X-TARGETDURATION:10\n#EXTINF:10,\n" + write_film(folder).string() + "\n";
    write_bytes(folder / "list.m3u8", std::as_bytes(std::span(playlist)));
    EXPECT_THAT(read_all(folder / "list.m3u8").error, HasSubstr("cannot be read as a video"));
}

TEST(VideoReader, ReportsTruncatedFiles) {
    const test::TemporaryFolder folder;
    const std::vector<std::byte> whole = bytes_of(write_film(folder));
    for (const double share : {0.1, 0.5, 0.9}) {
        const auto size = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
        write_bytes(folder / "cut.mp4", std::span(whole).first(size));
        const Reading reading = read_all(folder / "cut.mp4");
        EXPECT_THAT(reading.error, AnyOf(HasSubstr("complete video file"), HasSubstr("copy the video again")));
        EXPECT_EQ(reading.error.find('\n'), std::string::npos);
    }
    // The last three quarters of the frames' data are missing while the index at the end is there.
    const fs::path corpus = fs::path(RAYSPACE_SOURCE_DIR) / "tests" / "fuzz" / "corpus" / "film";
    const std::vector<std::byte> stream = bytes_of(corpus / "full-range.mkv");
    write_bytes(folder / "cut.mkv", std::span(stream).first(stream.size() / 3));
    EXPECT_NE(read_all(folder / "cut.mkv").error, "");
}

TEST(VideoReader, SurvivesFlippedBits) {
    const test::TemporaryFolder folder;
    const std::vector<std::byte> whole = bytes_of(write_film(folder));
    std::mt19937 random(3);
    for (int trial = 0; trial < 60; ++trial) {
        std::vector<std::byte> damaged = whole;
        for (int flip = 0; flip < 8; ++flip) damaged[random() % damaged.size()] ^= std::byte{1} << (random() % 8);
        write_bytes(folder / "damaged.mp4", damaged);
        const Reading reading = read_all(folder / "damaged.mp4");
        EXPECT_EQ(reading.error.find('\n'), std::string::npos);
        for (const Image<Rgba8>& frame : reading.frames) {
            EXPECT_EQ(frame.width(), reading.info.width);
            EXPECT_EQ(frame.height(), reading.info.height);
        }
    }
}

}  // namespace
}  // namespace rs
