// Views without their transparent margins.

#include "encode/set/packed_view.hpp"

#include <gtest/gtest.h>

namespace rs::encode {
namespace {

TEST(PackedView, KeepsAllPixels) {
    SynthesizedView view{Image<Rgba8>(9, 5), Image<float>(9, 5)};
    const auto draw = [&](int x, int y) {
        view.image(x, y) = {static_cast<std::uint8_t>(20 * x), static_cast<std::uint8_t>(30 * y), 3, 200};
        view.depth(x, y) = 1.0F + static_cast<float>(x) / 7;
    };
    for (const int x : {0, 1, 8}) draw(x, 0);  // both ends of a row, with a gap
    draw(4, 2);
    for (int x = 0; x < 9; ++x) draw(x, 4);
    const PackedView packed(view);
    EXPECT_EQ(packed.image(), view.image);
    EXPECT_EQ(packed.depth(), view.depth);
}

TEST(PackedView, ViewsWithoutAnObjectKeepTheirSize) {
    const SynthesizedView view{Image<Rgba8>(3, 2), Image<float>(3, 2)};
    EXPECT_EQ(PackedView(view).image(), view.image);
    EXPECT_EQ(PackedView(view).depth(), view.depth);
}

}  // namespace
}  // namespace rs::encode
