#include "capture/photos/segmentation/segmentation_checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace rs::capture {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kChecked_width = 100, kChecked_height = 80;

// Foreground images in which something covers columns 20 to 59 of the lower border, in one colour or in changing ones.
std::vector<Image<Rgba8>> foregrounds_at_border(int count, bool changes) {
    std::vector<Image<Rgba8>> foregrounds;
    for (int i = 0; i < count; ++i) {
        Image<Rgba8> foreground(kChecked_width, kChecked_height);
        const auto code = static_cast<std::uint8_t>(changes ? 40 * i % 256 : 90);
        for (int y = 40; y < kChecked_height; ++y) {
            for (int x = 20; x < 60; ++x) foreground(x, y) = {code, 60, 30, 255};
        }
        foregrounds.push_back(std::move(foreground));
    }
    return foregrounds;
}

TEST(StaticAtBorder, TellsBackgroundFromATurningObject) {
    EXPECT_TRUE(is_static_at_border(foregrounds_at_border(6, false)));
    EXPECT_FALSE(is_static_at_border(foregrounds_at_border(6, true)));
}

TEST(StaticAtBorder, NeedsSixPhotosAndAnObject) {
    EXPECT_FALSE(is_static_at_border(foregrounds_at_border(5, false)));
    EXPECT_FALSE(is_static_at_border({}));
    EXPECT_FALSE(is_static_at_border(std::vector<Image<Rgba8>>(6, Image<Rgba8>(kChecked_width, kChecked_height))));
}

// A flat plate, the object whose silhouette changes fastest.
std::vector<double> plate_coverage(int count) {
    std::vector<double> coverage;
    for (int i = 0; i < count; ++i) {
        coverage.push_back(0.3 * std::abs(std::cos(2 * std::numbers::pi * i / count)) + 0.01);
    }
    return coverage;
}

TEST(ContradictingSilhouettes, ARotatingPlateIsRigid) {
    for (const int count : {8, 12, 24, 36, 120}) {
        EXPECT_THAT(contradicting_silhouettes(plate_coverage(count)), IsEmpty()) << count;
    }
}

TEST(ContradictingSilhouettes, NamesThePhotoThatLacksAPart) {
    std::vector<double> coverage = plate_coverage(36);
    coverage[2] *= 0.6;
    EXPECT_THAT(contradicting_silhouettes(coverage), ElementsAre(2));
    coverage.resize(7);
    EXPECT_THAT(contradicting_silhouettes(coverage), IsEmpty()) << "too few photos";
}

struct CheckedTurn {
    PhotoFolder folder;
    SegmentedTurn turn{TurnSilhouette(kChecked_width, kChecked_height), {}, {}, {}, {}};
    explicit CheckedTurn(double coverage, bool is_at_border = false, int count = 12) {
        folder.width = kChecked_width;
        folder.height = kChecked_height;
        for (int i = 0; i < count; ++i) {
            folder.photos.emplace_back("photos/" + std::to_string(i) + ".jpg");
            turn.at_border.push_back(is_at_border ? 1 : 0);
            turn.coverage.push_back(coverage);
        }
        turn.small.assign(static_cast<std::size_t>(count), Image<Rgba8>(kChecked_width, kChecked_height));
    }
};

TEST(SegmentationChecks, AnObjectInTheMiddleIsUsable) {
    const CheckedTurn t(0.3);
    const SegmentationFindings found = check_segmentation(t.folder, t.turn, SegmenterKind::kBackground);
    EXPECT_THAT(found.problems, IsEmpty());
    EXPECT_THAT(found.notes, IsEmpty());
}

TEST(SegmentationChecks, HighCoverageIsAProblemUnlessTheAlphaIsGiven) {
    const CheckedTurn t(0.61);
    EXPECT_THAT(check_segmentation(t.folder, t.turn, SegmenterKind::kModel).problems,
                ElementsAre(HasSubstr("covers 61 % of the image")));
    EXPECT_THAT(check_segmentation(t.folder, t.turn, SegmenterKind::kAlpha).problems, IsEmpty());
}

TEST(SegmentationChecks, ContactWithTheBorderIsAProblemInMostPhotos) {
    CheckedTurn t(0.3, true);
    EXPECT_THAT(check_segmentation(t.folder, t.turn, SegmenterKind::kBackground).problems,
                ElementsAre(HasSubstr("12 of 12 photos")));
    for (int i = 0; i < 6; ++i) t.turn.at_border[static_cast<std::size_t>(i)] = 0;
    const SegmentationFindings found = check_segmentation(t.folder, t.turn, SegmenterKind::kBackground);
    EXPECT_THAT(found.problems, IsEmpty());
    EXPECT_THAT(found.notes, ElementsAre(HasSubstr("6 of 12 photos")));
}

TEST(SegmentationChecks, StaticContactIsKeptBackground) {
    CheckedTurn t(0.3, true);
    t.turn.small = foregrounds_at_border(12, false);
    EXPECT_THAT(check_segmentation(t.folder, t.turn, SegmenterKind::kBackground).problems,
                ElementsAre(HasSubstr("never changes")));
}

TEST(SegmentationChecks, OneTornMaskIsANoteAndManyAreAProblem) {
    CheckedTurn t(0.3, false, 30);
    t.turn.coverage[5] = 0.1;
    const SegmentationFindings one = check_segmentation(t.folder, t.turn, SegmenterKind::kBackground);
    EXPECT_THAT(one.problems, IsEmpty());
    EXPECT_THAT(one.notes, ElementsAre(HasSubstr("contradict")));
    for (std::size_t i = 5; i < 30; i += 4) t.turn.coverage[i] = 0.1;
    EXPECT_THAT(check_segmentation(t.folder, t.turn, SegmenterKind::kBackground).problems,
                ElementsAre(HasSubstr("contradict")));
}

}  // namespace
}  // namespace rs::capture
