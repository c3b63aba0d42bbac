#include "rayspace/image_io/image_io.hpp"
#include "tests/support/camera_jpeg.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace rs {
namespace {

TEST(ImageOrientation, IsWhatTheFileSays) {
    const test::TemporaryFolder folder;
    for (int orientation = 1; orientation <= 8; ++orientation) {
        test::write_oriented_jpeg(folder / "a.jpg", orientation);
        const Result<ImageInfo> info = read_image_info(folder / "a.jpg");
        ASSERT_TRUE(info.ok()) << info.error().message;
        EXPECT_EQ(info->orientation, orientation);
        EXPECT_EQ(info->width, 8);
        EXPECT_TRUE(read_image(folder / "a.jpg").ok()) << "the pixels are readable whatever the header says";
    }
}

TEST(ImageOrientation, IsOneWhereTheFileSaysNothingValid) {
    const test::TemporaryFolder folder;
    for (const int invalid : {0, 9, 0x0600, 0xFFFF}) {
        test::write_oriented_jpeg(folder / "a.jpg", invalid);
        const Result<ImageInfo> info = read_image_info(folder / "a.jpg");
        ASSERT_TRUE(info.ok()) << info.error().message;
        EXPECT_EQ(info->orientation, 1) << invalid;
    }
    ASSERT_TRUE(write_png(folder / "a.png", Image<Rgba8>(3, 2)).ok());
    EXPECT_EQ(read_image_info(folder / "a.png")->orientation, 1);
}

}  // namespace
}  // namespace rs
