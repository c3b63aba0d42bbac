#include "capture/photos/intake/survey.hpp"

#include <gtest/gtest.h>

namespace rs::capture {
namespace {

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
