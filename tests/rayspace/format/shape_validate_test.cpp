#include "rayspace/format/chunks/shape_chunk.hpp"

#include "tests/rayspace/format/int32_range.hpp"
#include "tests/support/small_shape.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace {

using namespace rs;
using test::small_object_with_shape;
using testing::HasSubstr;

constexpr std::int32_t k2To28 = 1 << 28;
constexpr std::int32_t k2To30 = 1 << 30;

std::string error_after(const std::function<void(ShapeMap&)>& change) {
    Ring ring = small_object_with_shape().rings[0];
    change(ring.shape);
    const Status status = object_chunks::check_shape(ring);
    return status.ok() ? "valid" : status.error().message;
}

// Tests that `member` may be lowest..highest and nothing beside it.
void expect_range(std::int32_t ShapeMap::*member, std::int32_t lowest, std::int32_t highest, const char* message) {
    SCOPED_TRACE(message);
    const auto with = [&](std::int32_t number) {
        return error_after([&](ShapeMap& shape) { shape.*member = number; });
    };
    EXPECT_EQ(with(lowest), "valid");
    EXPECT_EQ(with(highest), "valid");
    EXPECT_THAT(with(lowest - 1), HasSubstr(message));
    EXPECT_THAT(with(highest + 1), HasSubstr(message));
    EXPECT_THAT(with(kLowest), HasSubstr(message));
    EXPECT_THAT(with(kHighest), HasSubstr(message));
}

TEST(ValidateShape, TheSmallShapeIsValid) {
    EXPECT_EQ(error_after([](ShapeMap&) {}), "valid");
}

TEST(ValidateShape, NoShapeIsEmptyInAllItsMembers) {
    EXPECT_EQ(error_after([](ShapeMap& shape) { shape = {}; }), "valid");
    EXPECT_THAT(error_after([](ShapeMap& shape) { shape.gaps.clear(); }), HasSubstr("no gaps and yet"));
    EXPECT_THAT(error_after([](ShapeMap& shape) {
                    shape = {};
                    shape.depth_step_q24 = 1;
                }),
                HasSubstr("no gaps and yet"));
}

// Each bound is tested on both of its sides.
TEST(ValidateShape, Numbers) {
    expect_range(&ShapeMap::bands_per_unit_q12, 1, 1 << 26, "bands per unit");
    expect_range(&ShapeMap::h_low_q20, -k2To28 + 1, k2To28 - 1, "lowest height");
    expect_range(&ShapeMap::reference_distance_q20, (1 << 20) + 1, k2To28 - 1, "reference distance");
    expect_range(&ShapeMap::reference_height_q20, -k2To28 + 1, k2To28 - 1, "reference height");
    expect_range(&ShapeMap::depth_low_q20, -(1 << 21) - (1 << 16), (1 << 21) + (1 << 16), "lowest depth");
    expect_range(&ShapeMap::depth_step_q24, 1, 1 << 18, "depth step");
    expect_range(&ShapeMap::jump, 1, 255, "jump is not between 1 and 255 depth steps");
    expect_range(&ShapeMap::thickness, 0, 255, "thickness is not between 0 and 255 depth steps");
}

TEST(ValidateShape, Sides) {
    EXPECT_THAT(error_after([](ShapeMap& shape) { shape.p_cells = 0; }), HasSubstr("lines of 0x7 cells"));
    EXPECT_THAT(error_after([](ShapeMap& shape) { shape.p_cells = 4097; }), HasSubstr("4097x7"));
    EXPECT_THAT(error_after([](ShapeMap& shape) { shape.bands = -1; }), HasSubstr("9x-1"));
    EXPECT_THAT(error_after([](ShapeMap& shape) { shape.bands = 4097; }), HasSubstr("each side must be 1..4096"));

    const auto with_p_half = [](std::int32_t p_half_q20) {
        return error_after([=](ShapeMap& shape) {
            shape.p_half_q20 = p_half_q20;
            shape.p_cells_per_unit_q12 =
                static_cast<std::int32_t>(std::lround(4096 * shape.p_cells / (2 * std::ldexp(p_half_q20, -20))));
        });
    };
    EXPECT_EQ(with_p_half(1 << 20), "valid");
    EXPECT_EQ(with_p_half((2 << 20) + (1 << 16) - 1), "valid");
    EXPECT_THAT(with_p_half((1 << 20) - 1), HasSubstr("half width along p"));
    EXPECT_THAT(with_p_half((2 << 20) + (1 << 16)), HasSubstr("half width along p"));
    EXPECT_THAT(error_after([](ShapeMap& shape) { shape.p_cells_per_unit_q12 += 3; }), HasSubstr("contradict"));
    EXPECT_THAT(error_after([](ShapeMap& shape) { shape.p_cells_per_unit_q12 -= 3; }), HasSubstr("contradict"));
    EXPECT_THAT(error_after([](ShapeMap& shape) { shape.p_cells_per_unit_q12 = 0; }), HasSubstr("contradict"));
}

TEST(ValidateShape, Gaps) {
    EXPECT_THAT(error_after([](ShapeMap& shape) { shape.gaps.pop_back(); }), HasSubstr("one gap per view"));
    EXPECT_THAT(error_after([](ShapeMap& shape) { shape.gaps[2].first_line = 5; }),
                HasSubstr("gap 2 does not begin behind"));
    EXPECT_THAT(error_after([](ShapeMap& shape) { shape.gaps[0].first_line = 1; }), HasSubstr("gap 0"));
    EXPECT_THAT(error_after([](ShapeMap& shape) { shape.gaps[7].lines = 1025; }), HasSubstr("gap 7 has 1025 lines"));
    const auto with_last_gap = [](int lines, int bands) {
        return error_after([=](ShapeMap& shape) {
            shape.gaps[7].lines = static_cast<std::uint16_t>(lines);
            shape.bands = bands;
            const int all_lines = 14 + lines;
            shape.cells.assign(static_cast<std::size_t>(all_lines) * 9 * static_cast<std::size_t>(bands), ShapeCell{});
        });
    };
    EXPECT_EQ(with_last_gap(1024, 1), "valid");
    EXPECT_EQ(with_last_gap(0, 1), "valid");
    EXPECT_THAT(error_after([](ShapeMap& shape) { shape.cells.pop_back(); }), HasSubstr("as many cells as its sizes"));
    EXPECT_THAT(error_after([](ShapeMap& shape) {
                    shape.p_cells = 4096;
                    shape.p_cells_per_unit_q12 = static_cast<std::int32_t>(4096 * 4096 / (2 * 1.02));
                    shape.bands = 4096;
                }),
                HasSubstr("it has 268435456 cells; at most 134217728"));
}

TEST(ValidateShape, NormalLines) {
    const auto line = [](const std::function<void(NormalLine&)>& change) {
        return error_after([&](ShapeMap& shape) { change(shape.normal_lines[13]); });
    };
    EXPECT_EQ(line([](NormalLine& l) { l.l2_q30 = k2To30; }), "valid");
    EXPECT_EQ(line([](NormalLine& l) { l.l2_q30 = -k2To30; }), "valid");
    EXPECT_THAT(line([](NormalLine& l) { l.l2_q30 = k2To30 + 1; }), HasSubstr("the depth of one"));
    EXPECT_THAT(line([](NormalLine& l) { l.l2_q30 = kLowest; }), HasSubstr("the depth of one"));
    EXPECT_EQ(line([](NormalLine& l) { l.q2_q16 = k2To30 - 1; }), "valid");
    EXPECT_THAT(line([](NormalLine& l) { l.q2_q16 = k2To30; }), HasSubstr("the columns of one"));
    EXPECT_THAT(line([](NormalLine& l) { l.q2_q16 = -k2To30; }), HasSubstr("the columns of one"));
    for (const auto member : {&NormalLine::a_q20, &NormalLine::c_q20}) {
        EXPECT_EQ(line([&](NormalLine& l) { l.*member = k2To28 - 1; }), "valid");
        EXPECT_EQ(line([&](NormalLine& l) { l.*member = -k2To28 + 1; }), "valid");
        EXPECT_THAT(line([&](NormalLine& l) { l.*member = k2To28; }), HasSubstr("the camera of one"));
        EXPECT_THAT(line([&](NormalLine& l) { l.*member = kLowest; }), HasSubstr("the camera of one"));
    }
    EXPECT_THAT(error_after([](ShapeMap& shape) { shape.normal_lines.pop_back(); }),
                HasSubstr("one normal line per view and plane"));
}

TEST(ValidateShape, Cells) {
    const auto with = [](const ShapeCell& cell) {
        return error_after([&](ShapeMap& shape) { shape.cells[7] = cell; });
    };
    EXPECT_EQ(with({0, 0}), "valid");
    EXPECT_EQ(with({0, 1}), "valid");
    EXPECT_EQ(with({1, 1}), "valid");
    EXPECT_EQ(with({255, 2}), "valid");
    EXPECT_EQ(with({100, 3}), "valid");
    EXPECT_EQ(with({1, 0}), "cell 7 has a depth and no surface");
    EXPECT_EQ(with({255, 0}), "cell 7 has a depth and no surface");
    EXPECT_EQ(with({2, 4}), "cell 7 is shown by images that its gap does not have");
    EXPECT_EQ(with({0, 255}), "cell 7 is shown by images that its gap does not have");
}

}  // namespace
