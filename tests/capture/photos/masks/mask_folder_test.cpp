#include "capture/photos/masks/mask_folder.hpp"

#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/support/real_data.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kMask_width = 80;
constexpr int kMask_height = 60;

// Four photos of 80x60, which need not exist, and a folder for masks.
class Masks : public testing::Test {
protected:
    using Draw = std::function<Rgba8(bool is_object)>;

    static PhotoFolder photos(int width = kMask_width, int height = kMask_height) {
        PhotoFolder found;
        for (const char* name : {"a.jpg", "b.jpg", "c.jpg", "d.jpg"}) found.photos.emplace_back(fs::path("in") / name);
        found.shown_width = found.width = width;
        found.shown_height = found.height = height;
        return found;
    }
    // A disc of a quarter of the height around the centre.
    static bool is_object(double x, double y) {
        return std::hypot(x - kMask_width / 2.0, y - kMask_height / 2.0) < kMask_height / 4.0;
    }
    static Image<Rgba8> drawn(const Draw& draw, int width = kMask_width, int height = kMask_height) {
        Image<Rgba8> mask(width, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                mask(x, y) = draw(is_object((x + 0.5) * kMask_width / width, (y + 0.5) * kMask_height / height));
            }
        }
        return mask;
    }
    static Rgba8 grey(int code) {
        const auto c = static_cast<std::uint8_t>(code);
        return {c, c, c, 255};
    }
    static Rgba8 black_and_white(bool object) { return grey(object ? 255 : 0); }
    void write(const std::string& name, const Image<Rgba8>& mask) { ASSERT_TRUE(write_png(folder_ / name, mask).ok()); }
    void write_all(const Draw& draw, int width = kMask_width, int height = kMask_height,
                   const std::set<char>& but = {}) {
        for (const char name : {'a', 'b', 'c', 'd'}) {
            if (!but.contains(name)) write(std::string(1, name) + ".png", drawn(draw, width, height));
        }
    }
    Result<MaskFolder> open(MaskKind kind = MaskKind::kBinary) const {
        return MaskFolder::open(folder_.path(), photos(), kind);
    }
    std::string open_error(MaskKind kind = MaskKind::kBinary) const {
        const Result<MaskFolder> masks = open(kind);
        if (masks.ok()) return "no error";
        EXPECT_THAT(masks.error().message, testing::StartsWith(folder_.path().string()));
        EXPECT_THAT(masks.error().message, testing::Not(HasSubstr("\n")));
        return masks.error().message;
    }
    // Pixels of mask i that differ from the disc.
    static int differing(const MaskFolder& masks, std::size_t i) {
        const Result<Image<std::uint8_t>> mask = masks.read(i);
        EXPECT_TRUE(mask.ok()) << mask.error().message;
        if (!mask) return -1;
        EXPECT_EQ(mask->width(), kMask_width);
        EXPECT_EQ(mask->height(), kMask_height);
        int count = 0;
        for (int y = 0; y < kMask_height; ++y) {
            for (int x = 0; x < kMask_width; ++x)
                count += (*mask)(x, y) != (is_object(x + 0.5, y + 0.5) ? 255 : 0) ? 1 : 0;
        }
        return count;
    }
    void expect_disc(const std::vector<std::string>& notes, MaskKind kind = MaskKind::kBinary) const {
        const Result<MaskFolder> masks = open(kind);
        ASSERT_TRUE(masks.ok()) << masks.error().message;
        EXPECT_EQ(masks->kind(), kind);
        ASSERT_EQ(masks->size(), 4U);
        for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(differing(*masks, i), 0) << i;
        ASSERT_EQ(masks->notes().size(), notes.size()) << testing::PrintToString(masks->notes());
        for (std::size_t i = 0; i < notes.size(); ++i) EXPECT_THAT(masks->notes()[i], HasSubstr(notes[i]));
    }

    test::TemporaryFolder folder_;
};

TEST_F(Masks, InBlackAndWhiteAreReadWithoutANote) {
    write_all(black_and_white);
    expect_disc({});
    expect_disc({}, MaskKind::kAlpha);
}

TEST_F(Masks, AreReadByAlphaWhereTheyAreTransparent) {
    write_all([](bool object) { return object ? Rgba8{30, 10, 0, 255} : Rgba8{200, 180, 170, 0}; });
    expect_disc({"read by their alpha"});
    expect_disc({"read by their alpha"}, MaskKind::kAlpha);
}

// Brightness is not alpha: a dark object would become transparent.
TEST_F(Masks, OfAHalfTransparentObjectKeepItsAlpha) {
    write_all([](bool object) { return object ? Rgba8{30, 90, 20, 200} : Rgba8{}; });
    const Result<MaskFolder> alpha = open(MaskKind::kAlpha);
    ASSERT_TRUE(alpha.ok()) << alpha.error().message;
    const auto mask = alpha->read(0);
    ASSERT_TRUE(mask.ok()) << mask.error().message;
    EXPECT_EQ((*mask)(kMask_width / 2, kMask_height / 2), 200);
    EXPECT_EQ((*mask)(2, 2), 0);
    expect_disc({"read by their alpha",
                 "15 % of the masks are grey; codes from 128 are read as object. If grey is "
                 "the object's alpha, give --masks-alpha"});
}

TEST_F(Masks, OfAnotherKindThanTheOthersAreRefused) {
    write_all([](bool object) { return object ? Rgba8{30, 10, 0, 255} : Rgba8{}; });
    write("c.png", drawn(black_and_white));
    EXPECT_THAT(open_error(), HasSubstr("3 of 4 masks (first a.png) are transparent in places, 1 of 4 masks (first "
                                        "c.png) are opaque"));
}

TEST_F(Masks, OfZeroAndOneAreScaled) {
    write_all([](bool object) { return grey(object ? 1 : 0); });
    expect_disc({"masks hold 0 and 1 only; 1 is read as white"});
    expect_disc({"masks hold 0 and 1 only; 1 is read as white"}, MaskKind::kAlpha);
}

TEST_F(Masks, WithALabelForTheObjectAreScaled) {
    write_all([](bool object) { return object ? Rgba8{0, 64, 0, 255} : Rgba8{0, 0, 0, 255}; });
    expect_disc({"masks hold 0 and 64 only; 64 is read as white"});
}

TEST_F(Masks, OfOneGreyKeepItAsAlpha) {
    write_all([](bool object) { return grey(object ? 150 : 0); });
    expect_disc({"grey"});
    const Result<MaskFolder> alpha = open(MaskKind::kAlpha);
    ASSERT_TRUE(alpha.ok()) << alpha.error().message;
    EXPECT_EQ((*alpha->read(0))(kMask_width / 2, kMask_height / 2), 150);
    EXPECT_THAT(alpha->notes(), IsEmpty());
}

TEST_F(Masks, ThatAreInvertedAreTurnedWithANote) {
    write_all([](bool object) { return black_and_white(!object); });
    expect_disc({"masks are black where the object is; inverted"});
}

TEST_F(Masks, OfZeroAndOneMayBeInvertedToo) {
    write_all([](bool object) { return grey(object ? 0 : 1); });
    expect_disc({"1 is read as white", "inverted"});
}

TEST_F(Masks, ThatAreInvertedInTheMinorityAreNamed) {
    write_all(black_and_white);
    write("b.png", drawn([](bool object) { return black_and_white(!object); }));
    const Result<MaskFolder> masks = open();
    ASSERT_TRUE(masks.ok()) << masks.error().message;
    EXPECT_THAT(masks->notes(), ElementsAre(HasSubstr("1 of 4 masks (first b.png) look inverted, unlike the others")));
    EXPECT_EQ(differing(*masks, 0), 0);
    EXPECT_EQ(differing(*masks, 1), kMask_width * kMask_height);
}

// The turntable is part of the mask and reaches the border on three sides.
TEST_F(Masks, OfAnObjectThatFillsTheLowerHalfAreNotInverted) {
    Image<Rgba8> mask = drawn(black_and_white);
    for (int y = kMask_height / 2; y < kMask_height; ++y) {
        for (int x = 0; x < kMask_width; ++x) mask(x, y) = grey(255);
    }
    for (const char* name : {"a.png", "b.png", "c.png", "d.png"}) write(name, mask);
    const Result<MaskFolder> masks = open();
    ASSERT_TRUE(masks.ok()) << masks.error().message;
    EXPECT_THAT(masks->notes(), IsEmpty());
    EXPECT_EQ((*masks->read(0))(2, kMask_height - 2), 255);
}

TEST_F(Masks, OfOneColourOnlyAreRefused) {
    write_all(black_and_white);
    write("b.png", drawn([](bool) { return grey(0); }));
    write("d.png", drawn([](bool) { return grey(0); }));
    EXPECT_THAT(open_error(), HasSubstr("2 of 4 masks (first b.png) have no white pixel"));
    write_all([](bool) { return grey(255); });
    EXPECT_THAT(open_error(), HasSubstr("4 of 4 masks (first a.png) have no black pixel"));
}

TEST_F(Masks, ThatArePhotosAreRefused) {
    Image<Rgba8> photo(kMask_width, kMask_height);
    for (int y = 0; y < kMask_height; ++y) {
        for (int x = 0; x < kMask_width; ++x) photo(x, y) = {static_cast<std::uint8_t>(40 + 2 * x), 60, 30, 255};
    }
    for (const char* name : {"a.png", "b.png", "c.png", "d.png"}) write(name, photo);
    EXPECT_THAT(open_error(), HasSubstr("4 of 4 masks (first a.png) look like photos, not masks"));
}

TEST_F(Masks, OfTheSameAspectRatioAreResized) {
    write_all(black_and_white, 2 * kMask_width, 2 * kMask_height);
    expect_disc({"4 of 4 masks (first a.png) are 160x120; resized to 80x60"});
    write_all(black_and_white, kMask_width / 2, kMask_height / 2);
    const Result<MaskFolder> half = open();
    ASSERT_TRUE(half.ok()) << half.error().message;
    EXPECT_THAT(half->notes(), ElementsAre(HasSubstr("are 40x30; resized to 80x60")));
    EXPECT_LT(differing(*half, 0), 60) << "half a pixel along a circumference of 94 pixels";
    const Result<Image<std::uint8_t>> mask = half->read(0);
    ASSERT_TRUE(mask.ok()) << mask.error().message;
    for (const std::uint8_t code : mask->pixels()) EXPECT_TRUE(code == 0 || code == 255);
}

// 80x60 at a third is 26.7x20.
TEST_F(Masks, MayBeRoundedToWholePixels) {
    write_all(black_and_white, 27, 20);
    EXPECT_TRUE(open().ok()) << open_error();
    write_all(black_and_white, 26, 20);
    EXPECT_TRUE(open().ok()) << open_error();
    write_all(black_and_white, 29, 20);
    EXPECT_THAT(open_error(), HasSubstr("a.png: is 29x20, its photo a.jpg is shown in 80x60; masks must have"));
}

TEST_F(Masks, OfAnotherSizeAreRefusedNamingBoth) {
    write_all(black_and_white);
    write("c.png", drawn(black_and_white, 64, 64));
    EXPECT_THAT(open_error(), HasSubstr("c.png: is 64x64, its photo c.jpg is shown in 80x60"));
    write("c.png", drawn(black_and_white, kMask_height, kMask_width));
    EXPECT_THAT(open_error(), HasSubstr("c.png: is 60x80, its photo c.jpg is shown in 80x60; turn the masks by 90"));
    write("c.png", drawn(black_and_white, 4, 3));
    EXPECT_THAT(open_error(), HasSubstr("c.png: is 4x3"));
    write("c.png", drawn(black_and_white, 3 * kMask_width, 3 * kMask_height));
    EXPECT_THAT(open_error(), HasSubstr("c.png: is 240x180"));
}

TEST_F(Masks, ThatAreMissingAreCounted) {
    write_all(black_and_white, kMask_width, kMask_height, {'b', 'd'});
    EXPECT_THAT(open_error(), HasSubstr("has no mask for 2 of 4 photos, the first is b.jpg; add b.png, b.jpg.png or "
                                        "b_mask.png"));
}

TEST_F(Masks, ThatCannotBeReadAreNamed) {
    write_all(black_and_white);
    ASSERT_TRUE(write_file(folder_ / "c.png", "no image").ok());
    EXPECT_THAT(open_error(), HasSubstr("c.png"));
    const Result<MaskFolder> nowhere = MaskFolder::open(folder_ / "none", photos(), MaskKind::kBinary);
    ASSERT_FALSE(nowhere.ok());
    EXPECT_THAT(nowhere.error().message, HasSubstr("none: cannot be listed"));
}

TEST_F(Masks, ThatChangeTheirSizeMeanwhileAreRefused) {
    write_all(black_and_white);
    const Result<MaskFolder> masks = open();
    ASSERT_TRUE(masks.ok()) << masks.error().message;
    write("a.png", drawn(black_and_white, 40, 30));
    const auto read = masks->read(0);
    ASSERT_FALSE(read.ok());
    EXPECT_THAT(read.error().message, HasSubstr("has changed its size to 40x30"));
}

TEST_F(Masks, OfSeveralNamesAreChosenWithANote) {
    write_all(black_and_white);
    write("b_mask.png", drawn(black_and_white));
    const Result<MaskFolder> masks = open();
    ASSERT_TRUE(masks.ok()) << masks.error().message;
    EXPECT_EQ(masks->file(1), folder_ / "b.png");
    EXPECT_THAT(masks->notes(), ElementsAre(testing::AllOf(HasSubstr("1 of 4 photos have several masks"),
                                                           HasSubstr("used: b.png, not b_mask.png"))));
}

// Masks as a dozen tools write them, of one object that covers 21 % of the photos.
TEST(RealMasks, AreReadOrRefused) {
    const fs::path cases = RS_REAL_DATA_OR_SKIP("cases/49-import-masks-of-other-tools");
    const Result<PhotoFolder> photos = open_photo_folder(cases / "photos");
    ASSERT_TRUE(photos.ok()) << photos.error().message;
    const auto open = [&](const std::string& name, MaskKind kind = MaskKind::kBinary) {
        return MaskFolder::open(cases / ("masks-" + name), *photos, kind);
    };
    const auto expect_read = [&](const std::string& name, const std::string& note) {
        SCOPED_TRACE(name);
        const Result<MaskFolder> masks = open(name);
        ASSERT_TRUE(masks.ok()) << masks.error().message;
        if (note.empty()) {
            EXPECT_THAT(masks->notes(), IsEmpty());
        } else {
            EXPECT_THAT(masks->notes(), ElementsAre(HasSubstr(note)));
        }
        double object = 0, all = 0;
        for (std::size_t i = 0; i < masks->size(); ++i) {
            const auto mask = masks->read(i);
            ASSERT_TRUE(mask.ok()) << mask.error().message;
            for (const std::uint8_t code : mask->pixels()) object += code == 255 ? 1 : 0;
            all += static_cast<double>(mask->pixels().size());
        }
        EXPECT_NEAR(object / all, 0.21, 0.01);
    };
    for (const char* name : {"grey", "rgb", "one-bit", "jpg", "upper", "colmap-names", "suffix-mask", "soft-16bit"}) {
        expect_read(name, "");
    }
    expect_read("cutout", "read by their alpha");
    expect_read("rgba-alpha", "read by their alpha");
    expect_read("inverted", "inverted");
    expect_read("zero-one", "1 is read as white");
    expect_read("half-size", "resized to 240x192");
    const auto error = [&](const std::string& name) {
        const Result<MaskFolder> masks = open(name);
        return masks.ok() ? std::string("no error") : masks.error().message;
    };
    EXPECT_THAT(error("all-white"), HasSubstr("12 of 12 masks (first 000.png) have no black pixel"));
    EXPECT_THAT(error("one-missing"), HasSubstr("has no mask for 1 of 12 photos"));
    EXPECT_THAT(error("turned"), HasSubstr("turn the masks by 90 degrees"));
    EXPECT_TRUE(open("soft-16bit", MaskKind::kAlpha).ok());
}

}  // namespace
}  // namespace rs::capture
