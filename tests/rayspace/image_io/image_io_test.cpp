#include "rayspace/image_io/image_io.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/file/file_output.hpp"
#include "tests/support/png_header.hpp"
#include "tests/support/small_disk.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <random>
#include <thread>

namespace {

namespace fs = std::filesystem;
using namespace rs;
using test::TemporaryFolder;
using testing::HasSubstr;

Image<Rgba8> noise(int width, int height, unsigned seed = 1) {
    Image<Rgba8> image(width, height);
    std::mt19937 random(seed);
    for (Rgba8& p : image.pixels()) {
        const auto bits = random();
        p = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8U),
             static_cast<std::uint8_t>(bits >> 16U), static_cast<std::uint8_t>(bits >> 24U)};
    }
    return image;
}

void put_bytes(const fs::path& path, std::span<const std::byte> bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

void put_bytes(const fs::path& path, const std::string& text) {
    put_bytes(path, std::as_bytes(std::span(text)));
}

std::string image_error(const fs::path& path) {
    const auto image = read_image(path);
    EXPECT_FALSE(image.ok());
    if (image.ok()) return "";
    EXPECT_THAT(image.error().message, HasSubstr(path.string()));
    EXPECT_EQ(image.error().message.find('\n'), std::string::npos) << image.error().message;
    return image.error().message;
}

TEST(ImageIo, PngIsExactEvenUnderAlphaZero) {
    const TemporaryFolder folder;
    Image<Rgba8> image = noise(31, 17);
    for (int x = 0; x < 31; ++x) image(x, 3).a = 0;
    ASSERT_TRUE(write_png(folder / "a.png", image).ok());
    const auto back = read_image(folder / "a.png");
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_EQ(*back, image);
    const auto info = read_image_info(folder / "a.png");
    ASSERT_TRUE(info.ok());
    EXPECT_EQ(info->width, 31);
    EXPECT_EQ(info->height, 17);
    EXPECT_EQ(info->channels, 4);
    EXPECT_TRUE(info->has_alpha);
}

TEST(ImageIo, StridedViewsAreWritten) {
    const TemporaryFolder folder;
    const Image<Rgba8> image = noise(20, 20);
    const ConstImageView<Rgba8> crop = image.view().crop(3, 5, 9, 7);
    ASSERT_TRUE(write_png(folder / "a.png", crop).ok());
    const auto back = read_image(folder / "a.png");
    ASSERT_TRUE(back.ok());
    ASSERT_EQ(back->width(), 9);
    for (int y = 0; y < 7; ++y) {
        for (int x = 0; x < 9; ++x) ASSERT_EQ((*back)(x, y), crop(x, y));
    }
}

TEST(ImageIo, PngIsWrittenUnderAnyName) {
    const TemporaryFolder folder;
    // The function determines the format, not the extension.
    ASSERT_TRUE(write_png(folder / "a", noise(4, 4)).ok());
    EXPECT_TRUE(read_image(folder / "a").ok());
}

TEST(ImageIo, ExrKeepsStraightColour) {
    const TemporaryFolder folder;
    Image<RgbaF> image(5, 4);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 5; ++x)
            image(x, y) = {0.5F * static_cast<float>(x), 3.25F, 1e-3F, 0.25F * static_cast<float>(y)};
    }
    ASSERT_TRUE(write_exr(folder / "a.exr", image).ok());
    const auto back = read_image_linear(folder / "a.exr");
    ASSERT_TRUE(back.ok()) << back.error().message;
    for (int y = 1; y < 4; ++y) {
        for (int x = 0; x < 5; ++x) {
            EXPECT_NEAR((*back)(x, y).r, image(x, y).r, 1e-6);
            EXPECT_NEAR((*back)(x, y).g, image(x, y).g, 1e-6);
            EXPECT_NEAR((*back)(x, y).b, image(x, y).b, 1e-9);
            EXPECT_EQ((*back)(x, y).a, image(x, y).a);
        }
    }
    EXPECT_EQ((*back)(2, 0), (RgbaF{0, 0, 0, 0})) << "associated alpha keeps no colour under 0";
    // The same as 8-bit sRGB: 0.5 linear is code 188.
    const auto bytes = read_image(folder / "a.exr");
    ASSERT_TRUE(bytes.ok());
    EXPECT_EQ((*bytes)(1, 2), (Rgba8{188, 255, 3, 128}));
}

// OpenEXR allocates the sizes stated in a header before it reads the data.
TEST(ImageIo, ExrHeadersThatClaimMoreThanTheFileHasAreRefused) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_exr(folder / "sound.exr", Image<RgbaF>(5, 4)).ok());
    const auto sound = read_file(folder / "sound.exr", 1 << 20);
    ASSERT_TRUE(sound.ok());
    const std::string file(reinterpret_cast<const char*>(sound->data()), sound->size());
    const auto number = [](std::uint32_t value) {
        std::string bytes;
        for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 255U);
        return bytes;
    };
    // Inserts an attribute before all others.
    const auto with = [&](const std::string& type, std::uint32_t size, const std::string& value) {
        return file.substr(0, 8) + "remark" + '\0' + type + '\0' + number(size) + value + file.substr(8);
    };
    put_bytes(folder / "a.exr", with("string", 5, "sound"));
    EXPECT_TRUE(read_image_info(folder / "a.exr").ok());
    for (const std::string& faulty :
         {with("string", 0x70000000, "much"), with("string", 0xFFFFFFFF, "most"),
          with("stringvector", 12, number(0x70000000) + "12345678"), with("some", 0x7FFFFFFF, ""),
          with("preview", 12, number(8000) + number(8000) + "abcd"), file.substr(0, 60)}) {
        put_bytes(folder / "a.exr", faulty);
        EXPECT_THAT(read_image(folder / "a.exr").error().message, HasSubstr("a.exr: is damaged or cut short"));
        EXPECT_FALSE(read_image_info(folder / "a.exr").ok());
        EXPECT_FALSE(read_image_linear(folder / "a.exr").ok());
    }
    const std::size_t window = file.find("dataWindow") + std::strlen("dataWindow_box2i_") + 4;
    put_bytes(folder / "a.exr", file.substr(0, window + 8) + number(0x7FFFFFF0) + file.substr(window + 12));
    EXPECT_THAT(read_image(folder / "a.exr").error().message, HasSubstr("claims 2147483633x4 pixels"));
}

TEST(ImageIo, ChannelIsExact) {
    const TemporaryFolder folder;
    Image<float> depth(6, 3);
    for (int i = 0; i < 18; ++i) depth.pixels()[static_cast<std::size_t>(i)] = 1.0F / static_cast<float>(i + 1);
    ASSERT_TRUE(write_exr_channel(folder / "z.exr", depth.view().crop(1, 0, 5, 3)).ok());
    const auto back = read_channel(folder / "z.exr");
    ASSERT_TRUE(back.ok()) << back.error().message;
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 5; ++x) EXPECT_EQ((*back)(x, y), depth(x + 1, y));
    }
    const auto info = read_image_info(folder / "z.exr");
    ASSERT_TRUE(info.ok());
    EXPECT_EQ(info->channels, 1);
    EXPECT_FALSE(info->has_alpha);
}

TEST(ImageIo, GreySpreadsToRgb) {
    const TemporaryFolder folder;
    put_bytes(folder / "a.pgm", std::string("P5\n2 1\n255\n\x40\xC8"));
    const auto image = read_image(folder / "a.pgm");
    ASSERT_TRUE(image.ok()) << image.error().message;
    EXPECT_EQ((*image)(0, 0), (Rgba8{0x40, 0x40, 0x40, 255}));
    EXPECT_EQ((*image)(1, 0), (Rgba8{0xC8, 0xC8, 0xC8, 255}));
    const auto linear = read_image_linear(folder / "a.pgm");
    ASSERT_TRUE(linear.ok());
    EXPECT_NEAR((*linear)(0, 0).g, std::pow((64 / 255.0 + 0.055) / 1.055, 2.4), 1e-6);
    EXPECT_EQ((*linear)(0, 0).a, 1);
}

TEST(ImageIo, SixteenBitsAreRoundedToEight) {
    const TemporaryFolder folder;
    // 16-bit samples are big-endian: 257 * 100, 257 * 100 + 128, 257 * 100 + 129, 65535.
    put_bytes(folder / "a.ppm", std::string("P6\n2 1\n65535\n\x64\x64\x64\xE4\x64\xE5\xFF\xFF\x00\x00\x00\x81", 25));
    const auto image = read_image(folder / "a.ppm");
    ASSERT_TRUE(image.ok()) << image.error().message;
    EXPECT_EQ((*image)(0, 0), (Rgba8{100, 100, 101, 255}));
    EXPECT_EQ((*image)(1, 0), (Rgba8{255, 0, 1, 255}));
}

TEST(ImageIo, TruncatedPngIsAnError) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_png(folder / "a.png", noise(64, 64)).ok());
    const auto whole = read_file(folder / "a.png", 1 << 20);
    ASSERT_TRUE(whole.ok());
    for (const std::size_t eighths : {0, 1, 4, 7}) {
        put_bytes(folder / "cut.png", std::span(*whole).first(whole->size() * eighths / 8));
        EXPECT_FALSE(read_image(folder / "cut.png").ok()) << eighths;
        EXPECT_FALSE(read_image_linear(folder / "cut.png").ok()) << eighths;
        EXPECT_FALSE(read_channel(folder / "cut.png").ok()) << eighths;
    }
    put_bytes(folder / "cut.png", std::span(*whole).first(whole->size() / 2));
    EXPECT_THAT(image_error(folder / "cut.png"), HasSubstr("damaged or cut short"));
}

TEST(ImageIo, DamagedPngIsAnError) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_png(folder / "a.png", noise(64, 64)).ok());
    auto bytes = read_file(folder / "a.png", 1 << 20);
    ASSERT_TRUE(bytes.ok());
    for (const std::size_t at : {bytes->size() / 4, bytes->size() / 2, bytes->size() * 3 / 4}) {
        auto damaged = *bytes;
        damaged[at] ^= std::byte{0x10};
        put_bytes(folder / "bad.png", damaged);
        testing::internal::CaptureStderr();
        EXPECT_THAT(image_error(folder / "bad.png"), HasSubstr("is damaged"));
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "libraries do not print";
    }
}

TEST(ImageIo, HugeHeadersAreRefusedBeforeAnythingIsAllocated) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_png(folder / "a.png", noise(8, 8)).ok());
    auto bytes = read_file(folder / "a.png", 1 << 20);
    ASSERT_TRUE(bytes.ok());
    test::claim_size(*bytes, 60000, 60000);
    put_bytes(folder / "bomb.png", *bytes);
    EXPECT_FALSE(read_image_info(folder / "bomb.png").ok());
    EXPECT_THAT(image_error(folder / "bomb.png"), HasSubstr("claims 60000x60000 pixels; each side must be 1..8192"));
    test::claim_size(*bytes, 8193, 8);
    put_bytes(folder / "wide.png", *bytes);
    EXPECT_THAT(image_error(folder / "wide.png"), HasSubstr("8193x8"));
}

TEST(ImageIo, WhatIsNoImageIsNamed) {
    const TemporaryFolder folder;
    EXPECT_THAT(image_error(folder / "none.png"), HasSubstr("does not exist"));
    EXPECT_THAT(image_error(folder.path()), HasSubstr("is a folder"));
    put_bytes(folder / "text.png", std::string("this is no image, although it is called one"));
    EXPECT_THAT(image_error(folder / "text.png"), HasSubstr("cannot be read as an image"));
    put_bytes(folder / "empty.png", std::string());
    EXPECT_THAT(image_error(folder / "empty.png"), HasSubstr("empty.png: is an empty file; get it again or remove it"));
}

TEST(ImageIo, SizesThatCannotBeWrittenAreRefused) {
    const TemporaryFolder folder;
    EXPECT_THAT(write_png(folder / "a.png", Image<Rgba8>()).error().message, HasSubstr("0x0"));
    EXPECT_THAT(write_png(folder / "a.png", Image<Rgba8>(kMaxImageSide_px + 1, 1)).error().message,
                HasSubstr("8193x1"));
    EXPECT_THAT(write_png(folder.path() / "none" / "a.png", noise(4, 4)).error().message, HasSubstr("create it first"));
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ImageIo, AFullDiskLeavesNothing) {
    const TemporaryFolder folder;
    const test::SmallDisk disk(folder.path());
    if (!disk.mounted()) GTEST_SKIP() << "a small file system cannot be mounted here (it takes root)";
    const Status png = write_png(folder / "a.png", noise(256, 256));
    const Status exr = write_exr(folder / "a.exr", Image<RgbaF>(8000, 1000, RgbaF{1, 2, 3, 1}));
    const bool empty = fs::is_empty(folder.path());
    ASSERT_FALSE(png.ok());
    EXPECT_THAT(png.error().message, HasSubstr("no space left on device"));
    ASSERT_FALSE(exr.ok());
    EXPECT_THAT(exr.error().message, HasSubstr("no space left on device"));
    EXPECT_TRUE(empty);
}

TEST(ImageIo, ManyThreadsMayReadAndWrite) {
    const TemporaryFolder folder;
    std::atomic<int> good{0};
    {
        std::vector<std::jthread> threads;
        for (unsigned t = 0; t < 8; ++t) {
            threads.emplace_back([&, t] {
                const fs::path path = folder / (std::to_string(t) + ".png");
                const Image<Rgba8> image = noise(40, 30, t);
                if (!write_png(path, image)) return;
                const auto back = read_image(path);
                good += back.ok() && *back == image ? 1 : 0;
            });
        }
    }
    EXPECT_EQ(good, 8);
}

}  // namespace
