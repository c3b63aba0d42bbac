#include "capture/turns/joint_segmentation.hpp"

#include "rayspace/image_io/image_io.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;

constexpr int kSide_px = 120;
constexpr Rgba8 kWhite{255, 255, 255, 255}, kCream{255, 255, 245, 255}, kRed{180, 20, 20, 255};

// Photos of a red box with a cream roof before a wall, and their foreground images.
struct DrawnTurn {
    PhotoFolder folder;
    ForegroundCache foregrounds;
};

class JointSegmentation : public testing::Test {
protected:
    // The roof is `roof_px` high, and in the mask if `has_roof`.
    [[nodiscard]] DrawnTurn draw(const std::string& name, const Rgba8& wall, int roof_px, bool has_roof) const {
        const fs::path folder = folder_ / name, cut = folder_ / (name + "-cut");
        fs::create_directories(folder);
        fs::create_directories(cut);
        ForegroundCache foregrounds(cut, kSide_px, kSide_px);
        std::vector<fs::path> photos;
        for (int i = 0; i < 6; ++i) {
            Image<Rgba8> photo(kSide_px, kSide_px, wall), foreground(kSide_px, kSide_px);
            for (int y = 60 - roof_px; y < 85; ++y) {
                for (int x = 35 + i; x < 80 + i; ++x) {
                    photo(x, y) = y < 60 ? kCream : kRed;
                    if (y >= 60 || has_roof) foreground(x, y) = photo(x, y);
                }
            }
            photos.push_back(folder / (std::to_string(i) + ".png"));
            EXPECT_TRUE(write_png(photos.back(), photo).ok());
            EXPECT_TRUE(foregrounds.put(static_cast<std::size_t>(i), foreground).ok());
        }
        auto opened = open_photo_files(photos, name);
        EXPECT_TRUE(opened.ok());
        return {std::move(*opened), foregrounds};
    }

    [[nodiscard]] static TurnToCorrect given(const DrawnTurn& turn) {
        return {&turn.folder, &turn.foregrounds, {35, 86, 40, 86}};
    }

    rs::test::TemporaryFolder folder_;
};

TEST_F(JointSegmentation, AddsAPartThatAnotherTurnShows) {
    const DrawnTurn low = draw("low", kWhite, 6, false), high = draw("high", kWhite, 20, true);
    const auto corrected = correct_masks(std::vector{given(low), given(high)}, nullptr);
    ASSERT_TRUE(corrected.ok());
    ASSERT_NE((*corrected)[0].segmenter, nullptr);
    EXPECT_NEAR((*corrected)[0].added, 6.0 / 25, 0.02);
    EXPECT_EQ((*corrected)[1].segmenter, nullptr);
    const auto photo = read_photo(low.folder, 2);
    ASSERT_TRUE(photo.ok());
    const auto found = (*corrected)[0].segmenter->segment({2, photo->view()});
    ASSERT_TRUE(found.ok());
    EXPECT_EQ(found->mask(60, 57), 255);  // the roof
    EXPECT_EQ(found->mask(60, 70), 255);
    EXPECT_EQ(found->mask(60, 50), 0);
    EXPECT_EQ(found->mask(30, 57), 0);
}

TEST_F(JointSegmentation, KeepsAMaskWhoseBackgroundHasTheColour) {
    const DrawnTurn low = draw("low", kCream, 6, false), high = draw("high", kWhite, 20, true);
    const auto corrected = correct_masks(std::vector{given(low), given(high)}, nullptr);
    ASSERT_TRUE(corrected.ok());
    EXPECT_EQ((*corrected)[0].segmenter, nullptr);
    EXPECT_LT((*corrected)[0].added, 0.001);
}

}  // namespace
}  // namespace rs::capture
