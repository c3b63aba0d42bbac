#include "capture/photos/matte/still_at_border.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rs::capture {
namespace {

// Cut-outs in which something covers columns 20 to 59 of the lower border. It keeps its colour, or each has its own.
std::vector<Image<Rgba8>> cuts_of(int count, bool changes) {
    std::vector<Image<Rgba8>> cuts;
    for (int i = 0; i < count; ++i) {
        Image<Rgba8> cut(100, 80);
        const auto code = static_cast<std::uint8_t>(changes ? 40 * i % 256 : 90);
        for (int y = 40; y < 80; ++y) {
            for (int x = 20; x < 60; ++x) cut(x, y) = {code, 60, 30, 255};
        }
        cuts.push_back(std::move(cut));
    }
    return cuts;
}

TEST(StillAtBorder, WhatNeverChangesIsTheRoom) {
    EXPECT_TRUE(is_still_at_border(cuts_of(6, false)));
    EXPECT_FALSE(is_still_at_border(cuts_of(6, true))) << "the object turns";
}

TEST(StillAtBorder, AFewPicturesTellNothing) {
    EXPECT_FALSE(is_still_at_border(cuts_of(5, false)));
    EXPECT_FALSE(is_still_at_border({}));
}

TEST(StillAtBorder, NothingThere) {
    EXPECT_FALSE(is_still_at_border(std::vector<Image<Rgba8>>(6, Image<Rgba8>(100, 80))));
}

}  // namespace
}  // namespace rs::capture
