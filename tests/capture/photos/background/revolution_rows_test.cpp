#include "capture/photos/background/revolution_rows.hpp"

#include <gtest/gtest.h>

namespace rs::capture {
namespace {

constexpr int kSide_px = 60;
constexpr double kAxis_px = 30;

// A body from column 20 to 39 before a wall, seen whole in all pictures.
StillPicture still_body() {
    StillPicture still{Image<Rgba8>(kSide_px, kSide_px, Rgba8{90, 110, 160, 255}),
                       Image<float>(kSide_px, kSide_px, 1.0F)};
    for (int y = 0; y < kSide_px; ++y) {
        for (int x = 20; x < 40; ++x) {
            const auto lit = static_cast<std::uint8_t>(120 + 2 * (x - 20));  // from one side
            still.colour(x, y) = {lit, lit, lit, 255};
        }
    }
    return still;
}

TEST(RevolutionRows, AnEvenBodyMayBeOneOfRevolution) {
    const RevolutionRows rows(still_body(), kAxis_px);
    EXPECT_TRUE(rows.may_be_body(20, 30));
    EXPECT_TRUE(rows.may_be_body(39, 30));
    EXPECT_TRUE(rows.may_be_body(29, 30)) << "so near to the axis there is nothing to see";
}

TEST(RevolutionRows, AHighlightIsNoReasonAgainstItAndThingsAre) {
    StillPicture still = still_body();
    for (int x = 28; x < 31; ++x) still.colour(x, 10) = {250, 250, 250, 255};
    for (const int x : {25, 26, 32, 33}) still.colour(x, 20) = {250, 250, 250, 255};
    const RevolutionRows rows(still, kAxis_px);
    EXPECT_TRUE(rows.may_be_body(20, 10));
    EXPECT_FALSE(rows.may_be_body(20, 20));
    EXPECT_TRUE(rows.may_be_body(20, 21)) << "each row by itself";
}

// What is drawn on a body moves; so does an object before a wall, but it moves all over.
TEST(RevolutionRows, WhatMovesHasNoEdgesAndSomeOfABodyStandsStill) {
    StillPicture still = still_body();
    for (int x = 25; x < 33; ++x) {
        still.colour(x, 10) = still.colour(x, 20) = {static_cast<std::uint8_t>(x % 2 == 0 ? 250 : 10), 20, 20, 255};
        still.agreement(x, 10) = still.agreement(x, 20) = 0.3F;
    }
    for (int x = 22; x < 38; ++x) still.agreement(x, 20) = 0.3F;
    const RevolutionRows rows(still, kAxis_px);
    EXPECT_TRUE(rows.may_be_body(20, 10));
    EXPECT_FALSE(rows.may_be_body(20, 20));
}

TEST(RevolutionRows, TheOtherSideIsLookedForWhereItIsInThePicture) {
    const RevolutionRows rows(still_body(), kAxis_px);
    const auto is = [](int column) { return [column](int u) { return u == column; }; };
    EXPECT_TRUE(rows.any_mirrored(20, is(39)));
    EXPECT_TRUE(rows.any_mirrored(20, is(36)));
    EXPECT_FALSE(rows.any_mirrored(20, is(20)));
    const RevolutionRows aside(still_body(), 55);
    EXPECT_FALSE(aside.any_mirrored(40, [](int) { return true; })) << "beyond the picture";
}

TEST(RevolutionRows, LightMakesNoOtherSurface) {
    EXPECT_TRUE(alike_in_some_light({0.4F, 0.3F, 0.2F}, {0.2F, 0.15F, 0.1F}));
    EXPECT_FALSE(alike_in_some_light({0.4F, 0.3F, 0.2F}, {0.2F, 0.3F, 0.4F}));
}

}  // namespace
}  // namespace rs::capture
