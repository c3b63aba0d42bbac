#include "capture/photos/background/revolution_rows.hpp"

#include <gtest/gtest.h>

#include <initializer_list>

namespace rs::capture {
namespace {

constexpr int kWidth_px = 160, kRows = 30;
constexpr int kLeft_px = 50, kRight_px = 110;  // of the body
constexpr double kAxis_px = 80;

// A body in the middle before a wall of stripes as wide as `stripe_px`, or an even one; all of it stands still.
StillPicture still_body(int stripe_px) {
    StillPicture still{Image<Rgba8>(kWidth_px, kRows, Rgba8{90, 110, 160, 255}), Image<float>(kWidth_px, kRows, 1.0F)};
    for (int y = 0; y < kRows; ++y) {
        for (int x = 0; x < kWidth_px; ++x) {
            if (stripe_px > 0 && x / stripe_px % 2 == 0) still.colour(x, y) = {60, 60, 60, 255};
        }
        for (int x = kLeft_px; x < kRight_px; ++x) {
            const auto lit = static_cast<std::uint8_t>(120 + x / 2);  // from one side
            still.colour(x, y) = {lit, lit, lit, 255};
        }
    }
    return still;
}

RevolutionRows rows_of(const StillPicture& still, double axis_px = kAxis_px) {
    Image<std::uint8_t> untouched(kWidth_px, kRows);
    for (int y = 0; y < kRows; ++y) {
        for (int x = 0; x < kWidth_px; ++x) untouched(x, y) = x < kLeft_px || x >= kRight_px ? 255 : 0;
    }
    return {still, untouched, axis_px};
}

// Bars of eight pixels from each of these columns on, which stand still or move.
void draw_bars(StillPicture& still, int y, std::initializer_list<int> columns, bool move = false) {
    for (const int column : columns) {
        for (int x = column; x < column + 8; ++x) {
            still.colour(x, y) = {250, 30, 30, 255};
            if (move) still.agreement(x, y) = 0.3F;
        }
    }
}

TEST(RevolutionRows, ARowOfABodyIsMoreEvenThanTheRoomBesideIt) {
    StillPicture still = still_body(10);  // sixty pixels of it have six edges
    draw_bars(still, 5, {75});
    draw_bars(still, 10, {60, 90});
    const RevolutionRows rows = rows_of(still);
    EXPECT_TRUE(rows.may_be_body(kLeft_px, 15));
    EXPECT_TRUE(rows.may_be_body(kRight_px - 1, 15));
    EXPECT_TRUE(rows.may_be_body(kLeft_px, 5)) << "a highlight";
    EXPECT_FALSE(rows.may_be_body(kLeft_px, 10)) << "things";
    EXPECT_FALSE(rows.may_be_body(kRight_px - 1, 10));
    EXPECT_TRUE(rows.may_be_body(67, 10)) << "what lies between the things and the axis";
}

TEST(RevolutionRows, AnEvenBackdropSaysNothingAgainstIt) {
    StillPicture still = still_body(0);
    draw_bars(still, 10, {53, 66, 79, 92});
    EXPECT_TRUE(rows_of(still).may_be_body(kLeft_px, 10)) << "lamps that a glossy body mirrors";
}

TEST(RevolutionRows, WhatMovesHasNoEdges) {
    StillPicture still = still_body(10);
    draw_bars(still, 10, {55, 67, 79, 91}, true);
    EXPECT_TRUE(rows_of(still).may_be_body(kLeft_px, 10)) << "painted motifs";
}

TEST(RevolutionRows, WhereNearlyAllMovesAnObjectIsBeforeARoom) {
    StillPicture still = still_body(10);
    for (int x = 56; x < 104; ++x) still.agreement(x, 10) = 0.3F;
    EXPECT_FALSE(rows_of(still).may_be_body(kLeft_px, 10));
    EXPECT_TRUE(rows_of(still).may_be_body(kLeft_px, 11));
}

TEST(RevolutionRows, TheOtherSideIsLookedForWhereItIsInThePicture) {
    const RevolutionRows rows = rows_of(still_body(0));
    const auto is = [](int column) { return [column](int u) { return u == column; }; };
    EXPECT_TRUE(rows.any_mirrored(kLeft_px, is(kRight_px - 1)));
    EXPECT_TRUE(rows.any_mirrored(kLeft_px, is(kRight_px - 4)));
    EXPECT_FALSE(rows.any_mirrored(kLeft_px, is(kLeft_px)));
    EXPECT_FALSE(rows_of(still_body(0), 150).any_mirrored(100, [](int) { return true; })) << "beyond the picture";
}

}  // namespace
}  // namespace rs::capture
