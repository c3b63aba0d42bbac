#include "capture/photos/intake/photo_folder.hpp"

#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/support/camera_jpeg.hpp"
#include "tests/support/png_header.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string_view>

namespace rs::capture {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

void write_image(const std::filesystem::path& path, int width, int height) {
    const Status status = write_png(path, Image<Rgba8>(width, height, Rgba8{1, 2, 3, 255}));
    ASSERT_TRUE(status.ok()) << status.error().message;
}

std::vector<std::string> sorted(std::vector<std::string> names) {
    std::sort(names.begin(), names.end(), [](const auto& a, const auto& b) { return natural_less(a, b); });
    return names;
}

TEST(PhotoOrder, AnglesWithASignAreSortedByValue) {
    const auto in_order = [](std::vector<std::filesystem::path> names) {
        sort_photos(names);
        return names;
    };
    using Names = std::vector<std::filesystem::path>;
    EXPECT_EQ(in_order({"a_10.jpg", "a_-5.jpg", "a_0.jpg", "a_-20.jpg", "a_5.jpg"}),
              (Names{"a_-20.jpg", "a_-5.jpg", "a_0.jpg", "a_5.jpg", "a_10.jpg"}));
    EXPECT_EQ(in_order({"0.png", "-1.png", "1.png"}), (Names{"-1.png", "0.png", "1.png"}));
    EXPECT_EQ(in_order({"img_2.jpg", "img_1.jpg", "zoom-3.jpg"}), (Names{"img_1.jpg", "img_2.jpg", "zoom-3.jpg"}));
    EXPECT_EQ(in_order({"img-10.jpg", "img-9.jpg", "img-1.jpg"}), (Names{"img-1.jpg", "img-9.jpg", "img-10.jpg"}));
}

TEST(NaturalOrder, CountsAsPeopleDo) {
    EXPECT_THAT(sorted({"10.png", "2.png", "1.png"}), ElementsAre("1.png", "2.png", "10.png"));
    EXPECT_THAT(sorted({"v010.png", "v002.png", "v001.png"}), ElementsAre("v001.png", "v002.png", "v010.png"));
    EXPECT_THAT(sorted({"a2b10.jpg", "A2b9.jpg", "a10b1.jpg"}), ElementsAre("A2b9.jpg", "a2b10.jpg", "a10b1.jpg"));
    EXPECT_TRUE(natural_less("x99999999999999999999998", "x99999999999999999999999"));  // beyond 64 bits
}

TEST(NaturalOrder, IsTotal) {
    const std::vector<std::string> names = {"", "1", "01", "001", "1a", "a", "A", "a1", "a01", "b", "10", "0", "00"};
    for (const std::string& a : names) {
        EXPECT_FALSE(natural_less(a, a)) << a;
        for (const std::string& b : names) {
            if (a == b) continue;
            EXPECT_NE(natural_less(a, b), natural_less(b, a)) << a << " " << b;
            for (const std::string& c : names) {
                if (natural_less(a, b) && natural_less(b, c)) {
                    EXPECT_TRUE(natural_less(a, c)) << a << " " << b << " " << c;
                }
            }
        }
    }
}

TEST(PhotoFolder, ListsImagesOnlyInOrder) {
    const test::TemporaryFolder folder;
    for (const char* name : {"10.png", "9.png", "2.PNG"}) {
        // The writer detects the format from the lower-case extension; the test is about the case of the name.
        write_image(folder / "x.png", 4, 3);
        std::filesystem::rename(folder / "x.png", folder / name);
    }
    std::ofstream(folder / "notes.txt") << "not an image";
    std::ofstream(folder / ".hidden.png") << "not one either";
    const Result<PhotoFolder> found = open_photo_folder(folder.path());
    ASSERT_TRUE(found.ok()) << found.error().message;
    std::vector<std::string> names;
    for (const auto& photo : found->photos) names.push_back(photo.filename().string());
    EXPECT_THAT(names, ElementsAre("2.PNG", "9.png", "10.png"));
    EXPECT_THAT(found->ignored, ElementsAre("notes.txt"));
    EXPECT_EQ(found->width, 4);
    EXPECT_EQ(found->height, 3);
}

TEST(PhotoFolder, TakesAImageOnceThatIsThereInTwoFormats) {
    const test::TemporaryFolder folder;
    const auto opened = [&] {
        const Result<PhotoFolder> found = open_photo_folder(folder.path());
        EXPECT_TRUE(found.ok()) << found.error().message;
        return *found;
    };
    const Image<Rgba8> grey(4, 3, Rgba8{9, 9, 9, 255});
    for (const char* name : {"1.jpg", "2.jpg", "3.jpg"}) ASSERT_TRUE(write_jpeg(folder / name, grey, 90).ok());
    for (const char* name : {"1.png", "2.png"}) write_image(folder / name, 8, 6);
    EXPECT_THAT(file_names(opened()), ElementsAre("1.jpg", "2.jpg", "3.jpg")) << "the format that most have";
    EXPECT_THAT(opened().in_other_formats, ElementsAre("1.png", "2.png"));
    write_image(folder / "3.png", 8, 6);
    EXPECT_THAT(file_names(opened()), ElementsAre("1.jpg", "2.jpg", "3.jpg")) << "as many: the PNGs may be masks";
    write_image(folder / "4.png", 8, 6);
    EXPECT_THAT(file_names(opened()), ElementsAre("1.png", "2.png", "3.png", "4.png"));
    EXPECT_THAT(opened().in_other_formats, ElementsAre("1.jpg", "2.jpg", "3.jpg"));
}

TEST(PhotoFolder, RefusesWhatHoldsNoImages) {
    const test::TemporaryFolder folder;
    const Result<PhotoFolder> empty = open_photo_folder(folder.path());
    ASSERT_FALSE(empty.ok());
    EXPECT_THAT(empty.error().message, HasSubstr(folder.path().string() + ": holds no images; give"));
    for (const char* name : {"b.txt", "a.gif"}) std::ofstream(folder / name) << "x";
    const Result<PhotoFolder> others = open_photo_folder(folder.path());
    ASSERT_FALSE(others.ok());
    EXPECT_THAT(others.error().message, HasSubstr(": holds no images, but a.gif and 1 more; give"));
    EXPECT_FALSE(open_photo_folder(folder / "absent").ok());
}

TEST(PhotoFolder, NamesTwoImagesOfDifferentSize) {
    const test::TemporaryFolder folder;
    write_image(folder / "1.png", 6, 4);
    write_image(folder / "2.png", 6, 4);
    write_image(folder / "3.png", 6, 5);
    const Result<PhotoFolder> found = open_photo_folder(folder.path());
    ASSERT_FALSE(found.ok());
    for (const char* part : {"3.png", "6x5", "1.png", "6x4"}) EXPECT_THAT(found.error().message, HasSubstr(part));
}

TEST(PhotoFolder, TurnsAllAsMostWantToBeShown) {
    const test::TemporaryFolder folder;
    for (const char* name : {"1.jpg", "2.jpg", "3.jpg", "4.jpg"}) test::write_oriented_jpeg(folder / name, 6);
    Result<PhotoFolder> found = open_photo_folder(folder.path());
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_EQ(found->orientation, 6);
    EXPECT_EQ(found->other_orientation_count, 0);
    test::write_oriented_jpeg(folder / "2.jpg", 1);
    found = open_photo_folder(folder.path());
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_EQ(found->orientation, 6);
    EXPECT_EQ(found->other_orientation_count, 1);
}

// An editor saved one of several images that are stored on their side upright, with rotated pixels.
TEST(PhotoFolder, TurnsEachAsItStatesWhereOnlySomeLieOnTheirSide) {
    const test::TemporaryFolder folder;
    // White at the top: stored at the left, because orientation 6 displays stored rows as columns.
    Image<Rgba8> lying(48, 32, Rgba8{9, 9, 9, 255}), upright(32, 48, Rgba8{9, 9, 9, 255});
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 16; ++x) lying(x, y) = {255, 255, 255, 255};
    }
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 32; ++x) upright(x, y) = {255, 255, 255, 255};
    }
    for (const char* name : {"1.jpg", "3.jpg", "4.jpg"}) {
        ASSERT_TRUE(write_jpeg(folder / name, lying, 90).ok());
        // The last photo is of a camera that looks down and cannot sense its orientation.
        test::add_exif(folder / name, std::string_view(name) == "4.jpg" ? 8 : 6);
    }
    ASSERT_TRUE(write_jpeg(folder / "2.jpg", upright, 90).ok());
    const Result<PhotoFolder> found = open_photo_folder(folder.path());
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_EQ(found->own_orientations, (std::vector<int>{6, 1, 6, 6}));
    EXPECT_EQ(found->other_orientation_count, 1);
    EXPECT_TRUE(found->has_ambiguous_orientation());
    for (std::size_t i = 0; i < 4; ++i) {
        const Result<Image<Rgba8>> shown = read_photo(*found, i);
        ASSERT_TRUE(shown.ok()) << shown.error().message;
        EXPECT_EQ(shown->width(), 32);
        EXPECT_EQ(shown->height(), 48);
        EXPECT_GT((*shown)(16, 4).r, 200) << i;
        EXPECT_LT((*shown)(16, 44).r, 50) << i;
    }
    test::add_exif(folder / "2.jpg", 8);
    const Result<PhotoFolder> turned = open_photo_folder(folder.path());
    ASSERT_FALSE(turned.ok());
    for (const char* part : {"2.jpg", "48x32", "32x48", "EXIF"}) EXPECT_THAT(turned.error().message, HasSubstr(part));
}

TEST(PhotoFolder, SaysWhatPhotographsShowWhenTheyAreTurned) {
    const test::TemporaryFolder folder;
    for (const int orientation : {1, 3, 6}) {
        ASSERT_TRUE(write_jpeg(folder / "1.jpg", Image<Rgba8>(48, 32, Rgba8{9, 9, 9, 255}), 90).ok());
        test::add_exif(folder / "1.jpg", orientation);
        const Result<PhotoFolder> found = open_photo_folder(folder.path());
        ASSERT_TRUE(found.ok()) << found.error().message;
        EXPECT_EQ(found->shown_width, orientation == 6 ? 32 : 48);
        EXPECT_EQ(found->shown_height, orientation == 6 ? 48 : 32);
        EXPECT_EQ(found->width, found->shown_width);
        // By its size, a mask of 48 x 32 does not fit the displayed third photo; for the second it is ambiguous.
        EXPECT_EQ(found->has_ambiguous_orientation(), orientation == 3);
    }
    const Error error = ambiguous_orientation_error(*open_photo_folder(folder.path()), "--masks there");
    for (const char* part : {"--masks there", "orientation is 6", "exiftran"})
        EXPECT_THAT(error.message, HasSubstr(part));
}

TEST(PhotoFolder, MakesLargePhotographsSmaller) {
    const test::TemporaryFolder folder;
    write_image(folder / "1.png", 400, 381);
    const auto opened = [&](int max_side_px) {
        const Result<PhotoFolder> found = open_photo_folder(folder.path(), max_side_px);
        EXPECT_TRUE(found.ok());
        return *found;
    };
    EXPECT_EQ(opened(kMaxImageSide_px).width, 400);
    EXPECT_EQ(opened(320).width, 400) << "up to a quarter larger is not reduced";
    EXPECT_EQ(opened(320).reduction, 1);
    const PhotoFolder small = opened(128);
    EXPECT_EQ(small.reduction, 3.125);
    EXPECT_EQ(small.width, 128);
    EXPECT_EQ(small.height, 121);  // 121.92: the remainder is cropped
    EXPECT_EQ(small.shown_width, 400);
    EXPECT_EQ(small.in_image({200, 190.5}), glm::dvec2(64, 60.5)) << "the centre is unchanged";
    EXPECT_EQ(small.in_image({200 + 31.25, 190.5 - 62.5}), glm::dvec2(74, 40.5));
}

TEST(PhotoFolder, LeavesAPixelOfAThinPhotograph) {
    const test::TemporaryFolder folder;
    write_image(folder / "1.png", 2600, 1);
    const Result<PhotoFolder> thin = open_photo_folder(folder.path(), 2048);
    ASSERT_TRUE(thin.ok()) << thin.error().message;
    EXPECT_EQ(thin->reduction, 1);
    EXPECT_EQ(thin->width, 2600);
    write_image(folder / "1.png", 2600, 20);
    EXPECT_EQ(open_photo_folder(folder.path(), 64)->height, 1);
}

TEST(PhotoFolder, TakesPhotographsThatAreLargerThanImages) {
    const test::TemporaryFolder folder;
    write_image(folder / "1.png", kMaxImageSide_px, 64);
    // write_png() cannot write images as large; only the header is modified, because only that is read.
    const auto claim = [&](std::uint32_t width) {
        auto png = read_file(folder / "1.png", 1 << 20);
        ASSERT_TRUE(png.ok()) << png.error().message;
        test::claim_size(*png, width, 64);
        ASSERT_TRUE(write_file(folder / "1.png", *png).ok());
    };
    claim(9504);
    const Result<PhotoFolder> large = open_photo_folder(folder.path(), kMaxImageSide_px);
    ASSERT_TRUE(large.ok()) << large.error().message;
    EXPECT_EQ(large->shown_width, 9504);
    EXPECT_EQ(large->width, kMaxImageSide_px);
    claim(16385);
    EXPECT_FALSE(open_photo_folder(folder.path()).ok());
}

TEST(PhotoFolder, KnowsTheLensThatAllPhotographsState) {
    const test::TemporaryFolder folder;
    test::write_oriented_jpeg(folder / "1.jpg", 1, 26);
    test::write_oriented_jpeg(folder / "2.jpg", 1, 26);
    EXPECT_EQ(open_photo_folder(folder.path())->focal_35mm, 26);
    test::write_oriented_jpeg(folder / "3.jpg", 1, 52);
    EXPECT_EQ(open_photo_folder(folder.path())->focal_35mm, 0);
    test::write_oriented_jpeg(folder / "3.jpg", 1);
    EXPECT_EQ(open_photo_folder(folder.path())->focal_35mm, 0);
}

TEST(PhotoFolder, TakesWhatPhonesWrite) {
    for (const char* name : {"a.jpg", "IMG_1.HEIC", "b.heif", "c.avif", "d.tif"})
        EXPECT_TRUE(is_image_name(name)) << name;
    for (const char* name : {"a.cr2", "heic", "b.txt"}) EXPECT_FALSE(is_image_name(name)) << name;
}

TEST(PhotoFolder, NamesAImageThatIsNone) {
    const test::TemporaryFolder folder;
    write_image(folder / "1.png", 6, 4);
    std::ofstream(folder / "2.png") << "no PNG at all";
    const Result<PhotoFolder> found = open_photo_folder(folder.path());
    ASSERT_FALSE(found.ok());
    EXPECT_THAT(found.error().message, HasSubstr("2.png"));
}

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
