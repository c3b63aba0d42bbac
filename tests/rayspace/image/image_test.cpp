#include "rayspace/image/image.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace {

using namespace rs;

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
