#include "capture/photos/intake/survey.hpp"

#include <gtest/gtest.h>

namespace rs::capture {
namespace {

TEST(Reduced, IsACopyWhereThePictureIsSmall) {
    Image<Rgba8> picture(7, 5, Rgba8{1, 2, 3, 0});
    picture(3, 2) = {9, 8, 7, 6};
    EXPECT_EQ(reduced(picture, 7), picture);
}

TEST(Reduced, AveragesWhatEachPixelCovers) {
    // 3 pixels over 2: the middle one is shared. Weights 2/3 and 1/3.
    Image<Rgba8> row(3, 1, Rgba8{0, 0, 0, 255});
    row(0, 0).r = 90;
    row(1, 0).g = 90;
    row(2, 0).b = 90;
    const Image<Rgba8> two = reduced(row, 2);
    ASSERT_EQ(two.width(), 2);
    ASSERT_EQ(two.height(), 1);
    EXPECT_EQ(two(0, 0), (Rgba8{60, 30, 0, 255}));
    EXPECT_EQ(two(1, 0), (Rgba8{0, 30, 60, 255}));

    Image<Rgba8> column(1, 3, Rgba8{0, 0, 0, 255});
    for (int y = 0; y < 3; ++y) column(0, y) = row(y, 0);
    const Image<Rgba8> upright = reduced(column, 2);
    ASSERT_EQ(upright.height(), 2);
    EXPECT_EQ(upright(0, 0), two(0, 0));
    EXPECT_EQ(upright(0, 1), two(1, 0));
}

TEST(Reduced, WeighsColoursByAlpha) {
    Image<Rgba8> picture(4, 4, Rgba8{255, 255, 255, 0});
    for (int y = 0; y < 4; ++y) picture(0, y) = {200, 100, 50, 255};
    const Image<Rgba8> small = reduced(picture, 2);
    EXPECT_EQ(small(0, 0), (Rgba8{200, 100, 50, 128}));
    EXPECT_EQ(small(1, 1), (Rgba8{0, 0, 0, 0}));
}

TEST(Reduced, KeepsAnEvenPictureEvenAtAnyRatio) {
    const Rgba8 even{17, 130, 254, 255};
    for (const int side : {1, 2, 37, 99, 160}) {
        const Image<Rgba8> small = reduced(Image<Rgba8>(161, 103, even), side);
        EXPECT_EQ(small.width(), side);
        for (const Rgba8& p : small.pixels()) ASSERT_EQ(p, even) << side;
    }
}

TEST(Border, IsFlatWhereItShowsOneColour) {
    Image<Rgba8> photo(40, 30, Rgba8{250, 251, 249, 255});
    EXPECT_EQ(border_of(photo).median, (Rgba8{250, 251, 249, 255}));
    EXPECT_TRUE(border_of(photo).flat);
    for (int x = 0; x < 40; x += 3) photo(x, 0) = {249, 252, 248, 255};  // as JPEG leaves it
    for (int y = 10; y < 20; ++y) photo(0, y) = {90, 20, 20, 255};       // the object
    EXPECT_TRUE(border_of(photo).flat);
    for (int x = 0; x < 40; x += 3) photo(x, 0) = {246, 247, 245, 255};
    EXPECT_FALSE(border_of(photo).flat) << "14 of 126 are 4 codes off";
    EXPECT_TRUE(border_of(Image<Rgba8>(40, 30, Rgba8{128, 60, 10, 255})).flat) << "of any colour";

    photo = Image<Rgba8>(40, 30, Rgba8{0, 0, 0, 255});
    EXPECT_TRUE(border_of(photo).flat);
    photo(5, 0) = {1, 0, 0, 255};
    EXPECT_FALSE(border_of(photo).flat) << "black to the code";
    photo(5, 0) = {40, 0, 0, 255};
    EXPECT_TRUE(border_of(photo).flat) << "the object";
    EXPECT_FALSE(border_of(Image<Rgba8>{}).flat);
}

}  // namespace
}  // namespace rs::capture
