#include "capture/photos/intake/photo_reader.hpp"

#include "rayspace/image_io/image_io.hpp"
#include "tests/support/camera_jpeg.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace rs::capture {
namespace {

// One pixel per letter, one string per row.
Image<Rgba8> image_of(const std::vector<std::string>& rows) {
    Image<Rgba8> image(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()));
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const char letter = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
            image(x, y) = {static_cast<std::uint8_t>(letter), 0, 0, 255};
        }
    }
    return image;
}

TEST(ApplyOrientation, FollowsExif) {
    const Image<Rgba8> stored = image_of({"abc", "def"});
    const std::vector<std::vector<std::string>> shown = {
        {"abc", "def"},      // 1: as stored
        {"cba", "fed"},      // 2: the first column is at the right
        {"fed", "cba"},      // 3: upside down
        {"def", "abc"},      // 4: the first row is at the bottom
        {"ad", "be", "cf"},  // 5: the first row is at the left
        {"da", "eb", "fc"},  // 6: the first row is at the right, the first column at the top
        {"fc", "eb", "da"},  // 7: the first row is at the right, the first column at the bottom
        {"cf", "be", "ad"},  // 8: the first row is at the left, the first column at the bottom
    };
    for (int orientation = 1; orientation <= 8; ++orientation) {
        EXPECT_EQ(apply_orientation(stored, orientation), image_of(shown[static_cast<std::size_t>(orientation - 1)]))
            << orientation;
    }
}

TEST(ReadPhotograph, IsUprightAndHasTheRequestedSize) {
    const test::TemporaryFolder folder;
    Image<Rgba8> stored(320, 192, Rgba8{20, 20, 20, 255});
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 320; ++x) stored(x, y) = {200, 200, 200, 255};  // light above
    }
    ASSERT_TRUE(write_jpeg(folder / "1.jpg", stored, 95).ok());
    test::add_exif(folder / "1.jpg", 8);
    const Result<PhotoFolder> found = open_photo_folder(folder.path(), 80);
    ASSERT_TRUE(found.ok()) << found.error().message;
    const Result<Image<Rgba8>> photograph = read_photo(*found, 0);
    ASSERT_TRUE(photograph.ok()) << photograph.error().message;
    ASSERT_EQ(photograph->width(), 48);
    ASSERT_EQ(photograph->height(), 80);
    EXPECT_NEAR((*photograph)(10, 40).r, 200, 3) << "the first row is at the left";
    EXPECT_NEAR((*photograph)(37, 40).r, 20, 3);

    ASSERT_TRUE(write_jpeg(folder / "1.jpg", stored, 95).ok());  // without an orientation
    const Result<Image<Rgba8>> other = read_photo(*found, 0);
    ASSERT_TRUE(other.ok()) << "the orientation was read before";
    ASSERT_TRUE(write_jpeg(folder / "1.jpg", Image<Rgba8>(320, 200), 95).ok());
    const Result<Image<Rgba8>> changed = read_photo(*found, 0);
    ASSERT_FALSE(changed.ok());
    EXPECT_THAT(changed.error().message, testing::HasSubstr("1.jpg: changed"));
}

}  // namespace
}  // namespace rs::capture
