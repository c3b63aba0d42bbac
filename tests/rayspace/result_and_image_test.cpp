#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <string>

namespace {

using namespace rs;

TEST(Result, HoldsAValueOrAnError) {
    const Result<int> good = 7;
    ASSERT_TRUE(good.ok());
    EXPECT_EQ(*good, 7);
    const Result<int> bad = Error{"file: broken"};
    ASSERT_FALSE(bad.ok());
    EXPECT_EQ(bad.error().message, "file: broken");
}

TEST(Result, GivesMoveOnlyValuesAway) {
    Result<std::unique_ptr<int>> made = std::make_unique<int>(3);
    const std::unique_ptr<int> taken = std::move(made).value();
    EXPECT_EQ(*taken, 3);
}

TEST(Result, StringsAreValuesAndNotErrors) {
    const Result<std::string> text = std::string("text");
    ASSERT_TRUE(text.ok());
    EXPECT_EQ(text->size(), 4U);
}

TEST(ResultDeathTest, TheWrongSideStopsTheProgram) {
    const Result<int> bad = Error{"no"};
    EXPECT_DEATH((void)bad.value(), "check failed");
    const Result<int> good = 1;
    EXPECT_DEATH((void)good.error(), "check failed");
    EXPECT_DEATH((void)Status{}.error(), "check failed");
}

TEST(Status, IsOkUnlessGivenAnError) {
    EXPECT_TRUE(Status{}.ok());
    EXPECT_FALSE(Status{Error{"x"}}.ok());
}

Image<int> numbered(int width, int height) {
    Image<int> image(width, height);
    std::iota(image.pixels().begin(), image.pixels().end(), 0);
    return image;
}

TEST(Image, IsDenseInRows) {
    const Image<int> image = numbered(5, 3);
    EXPECT_EQ(image(4, 2), 14);
    EXPECT_EQ(image.row(1)[2], 7);
    EXPECT_EQ(image.view().stride(), 5);
    EXPECT_EQ(image.pixels().size(), 15U);
}

TEST(ImageView, CropSharesPixelsAndKeepsTheStride) {
    Image<int> image = numbered(5, 4);
    const ImageView<int> crop = image.view().crop(1, 2, 3, 2);
    EXPECT_EQ(crop.stride(), 5);
    EXPECT_EQ(crop(0, 0), 11);
    EXPECT_EQ(crop(2, 1), 18);
    crop(2, 1) = -1;
    EXPECT_EQ(image(3, 3), -1);
    EXPECT_EQ(crop.row_span(0).size(), 3U);
    const ConstImageView<int> constant = crop;
    EXPECT_EQ(constant(2, 1), -1);
}

TEST(ImageView, EmptyCropsAreAllowedAtTheEdges) {
    Image<int> image = numbered(5, 4);
    EXPECT_TRUE(image.view().crop(5, 4, 0, 0).empty());
    EXPECT_TRUE(Image<int>().view().empty());
}

TEST(ImageViewDeathTest, CropsThatReachOutStopTheProgram) {
    Image<int> image = numbered(5, 4);
    EXPECT_DEATH((void)image.view().crop(3, 0, 3, 1), "check failed");
    EXPECT_DEATH((void)image.view().crop(-1, 0, 2, 1), "check failed");
}

}  // namespace
