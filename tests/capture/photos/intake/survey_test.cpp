#include "capture/photos/intake/survey.hpp"

#include <gtest/gtest.h>

namespace rs::capture {
namespace {

TEST(Border, IsFlatIfUniform) {
    Image<Rgba8> photo(40, 30, Rgba8{250, 251, 249, 255});
    EXPECT_EQ(measure_border(photo).median, (Rgba8{250, 251, 249, 255}));
    EXPECT_TRUE(measure_border(photo).flat);
    for (int x = 0; x < 40; x += 3) photo(x, 0) = {249, 252, 248, 255};  // JPEG compression
    for (int y = 10; y < 20; ++y) photo(0, y) = {90, 20, 20, 255};       // the object
    EXPECT_TRUE(measure_border(photo).flat);
    for (int x = 0; x < 40; x += 3) photo(x, 0) = {246, 247, 245, 255};
    EXPECT_FALSE(measure_border(photo).flat) << "14 of 126 are 4 codes off";
    EXPECT_TRUE(measure_border(Image<Rgba8>(40, 30, Rgba8{128, 60, 10, 255})).flat) << "of any colour";

    photo = Image<Rgba8>(40, 30, Rgba8{0, 0, 0, 255});
    EXPECT_TRUE(measure_border(photo).flat);
    photo(5, 0) = {1, 0, 0, 255};
    EXPECT_FALSE(measure_border(photo).flat) << "black to the code";
    photo(5, 0) = {40, 0, 0, 255};
    EXPECT_TRUE(measure_border(photo).flat) << "the object";
    EXPECT_FALSE(measure_border(Image<Rgba8>{}).flat);
}

}  // namespace
}  // namespace rs::capture
