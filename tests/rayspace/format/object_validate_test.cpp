#include "rayspace/format/object_file.hpp"
#include "tests/rayspace/format/int32_range.hpp"
#include "tests/support/small_object.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace {

using namespace rs;
using test::small_object;
using testing::HasSubstr;

std::string error_after(const std::function<void(RaySpaceObject&)>& change) {
    RaySpaceObject object = small_object();
    change(object);
    const Status status = validate_object(object, "O");
    return status.ok() ? "valid" : status.error().message;
}

TEST(ValidateObject, TheSmallObjectIsValidAndNotTrivial) {
    EXPECT_EQ(error_after([](RaySpaceObject&) {}), "valid");
    std::vector<int> uses(8);
    const RaySpaceObject object = small_object();
    for (const std::uint16_t view : object.rings[0].cells) {
        if (view != kNoImage) ++uses[view];
    }
    for (const int n : uses) EXPECT_GT(n, 50);
}

TEST(ValidateObject, Head) {
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.width = 0; }), HasSubstr("O: images of 0x10 pixels"));
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.height = kMaxImageSide_px + 1; }), HasSubstr("12x8193"));
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.views.clear(); }), HasSubstr("0 views"));
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.rings.clear(); }), HasSubstr("0 rings"));
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.rings.resize(kMaxRings + 1); }), HasSubstr("65 rings"));
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.images.pop_back(); }), HasSubstr("not as many images"));
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.name = std::string(256, 'a'); }), HasSubstr("name"));
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.name = "a\nb"; }), HasSubstr("name"));
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.name = "\xff"; }), HasSubstr("name"));
    EXPECT_EQ(error_after([](RaySpaceObject& o) { o.name = "J\xC3\xA4ger"; }), "valid");
    for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
        EXPECT_THAT(error_after([&](RaySpaceObject& o) { o.units_per_radius = bad; }), HasSubstr("units per radius"));
    }
}

TEST(ValidateObject, Rig) {
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.rig_json = "{"; }), HasSubstr("O: rig: is not valid JSON"));
    EXPECT_THAT(error_after([](RaySpaceObject& o) {
                    Rig rig = *rig_from_json(o.rig_json, "R");
                    rig.views.pop_back();
                    o.rig_json = rig_to_json(rig);
                }),
                HasSubstr("as many frames as views"));
}

// Each bound is tested on both of its sides.
TEST(ValidateObject, ViewNumbers) {
    const auto view = [](const std::function<void(CapturedView&)>& change) {
        return error_after([&](RaySpaceObject& o) { change(o.views[2]); });
    };
    constexpr std::int32_t k2To30 = 1 << 30;
    for (const auto member : {&CapturedView::cx_q16, &CapturedView::cy_q16}) {
        EXPECT_EQ(view([&](CapturedView& v) { v.*member = k2To30 - 1; }), "valid");
        EXPECT_EQ(view([&](CapturedView& v) { v.*member = -k2To30 + 1; }), "valid");
        EXPECT_THAT(view([&](CapturedView& v) { v.*member = k2To30; }), HasSubstr("view 2: its principal point"));
        EXPECT_THAT(view([&](CapturedView& v) { v.*member = kLowest; }), HasSubstr("view 2: its principal point"));
    }
    EXPECT_EQ(view([](CapturedView& v) { v.fl_y_q16 = 1; }), "valid");
    EXPECT_EQ(view([](CapturedView& v) { v.fl_y_q16 = k2To30 - 1; }), "valid");
    EXPECT_THAT(view([](CapturedView& v) { v.fl_y_q16 = 0; }), HasSubstr("focal length"));
    EXPECT_THAT(view([](CapturedView& v) { v.fl_y_q16 = k2To30; }), HasSubstr("focal length"));
    EXPECT_EQ(view([](CapturedView& v) { v.height_q20 = (1 << 28) - 1; }), "valid");
    EXPECT_THAT(view([](CapturedView& v) { v.height_q20 = 1 << 28; }), HasSubstr("height"));
    EXPECT_THAT(view([](CapturedView& v) { v.height_q20 = kLowest; }), HasSubstr("height"));
}

TEST(ValidateObject, LineNumbers) {
    const auto line = [](const std::function<void(CapturedLine&)>& change) {
        return error_after([&](RaySpaceObject& o) { change(o.views[2].lines[1]); });
    };
    EXPECT_EQ(line([](CapturedLine& l) { l.l0_q20 = (1 << 28) - 1; }), "valid");
    EXPECT_THAT(line([](CapturedLine& l) { l.l0_q20 = 1 << 28; }), HasSubstr("view 2: the depth"));
    EXPECT_EQ(line([](CapturedLine& l) { l.l1_q30 = 1 << 30; }), "valid");
    EXPECT_EQ(line([](CapturedLine& l) { l.l1_q30 = -(1 << 30); }), "valid");
    EXPECT_THAT(line([](CapturedLine& l) { l.l1_q30 = (1 << 30) + 1; }), HasSubstr("the depth"));
    EXPECT_EQ(line([](CapturedLine& l) { l.q0_q16 = kHighest; }), "valid");
    EXPECT_EQ(line([](CapturedLine& l) { l.q0_q16 = kLowest + 1; }), "valid");
    EXPECT_THAT(line([](CapturedLine& l) { l.q0_q16 = kLowest; }), HasSubstr("the columns"));
    EXPECT_EQ(line([](CapturedLine& l) { l.q1_q16 = (1 << 30) - 1; }), "valid");
    EXPECT_THAT(line([](CapturedLine& l) { l.q1_q16 = 1 << 30; }), HasSubstr("the columns"));
    EXPECT_THAT(line([](CapturedLine& l) { l.q1_q16 = kLowest; }), HasSubstr("the columns"));
}

TEST(ValidateObject, RingGeometry) {
    const auto ring = [](const std::function<void(Ring&)>& change) {
        return error_after([&](RaySpaceObject& o) { change(o.rings[0]); });
    };
    EXPECT_EQ(ring([](Ring& r) { r.elevation_udeg = -90'000'000; }), "valid");
    EXPECT_THAT(ring([](Ring& r) { r.elevation_udeg = 90'000'001; }), HasSubstr("ring 0: its elevation"));
    EXPECT_THAT(ring([](Ring& r) { r.elevation_udeg = kLowest; }), HasSubstr("ring 0: its elevation"));
    EXPECT_THAT(ring([](Ring& r) { r.planes = 2; }), HasSubstr("2 planes"));
    EXPECT_THAT(ring([](Ring& r) { r.planes = 65; }), HasSubstr("65 planes"));
    EXPECT_THAT(ring([](Ring& r) { r.x_cells = 0; }), HasSubstr("0x16 cells"));
    EXPECT_THAT(ring([](Ring& r) { r.u_cells = 4097; }), HasSubstr("16x4097 cells"));

    // For 4 planes tan(pi / 4) = 1: u_half must be above 1 and at most 2, exactly.
    const auto with_u_half = [&](std::int32_t u_half_q28) {
        return ring([=](Ring& r) {
            r.u_half_q28 = u_half_q28;
            r.u_cells_per_unit_q12 =
                static_cast<std::int32_t>(std::lround(4096 * 16 / (2 * std::ldexp(u_half_q28, -28))));
        });
    };
    EXPECT_EQ(with_u_half((1 << 28) + 1), "valid");
    EXPECT_EQ(with_u_half(1 << 29), "valid");
    EXPECT_THAT(with_u_half((1 << 28) - 1), HasSubstr("half width along u"));
    EXPECT_THAT(with_u_half((1 << 29) + 1), HasSubstr("half width along u"));
    EXPECT_THAT(with_u_half(-(1 << 28)), HasSubstr("half width along u"));

    const auto with_x_half = [&](std::int32_t x_half_q20) {
        return ring([=](Ring& r) {
            r.x_half_q20 = x_half_q20;
            r.x_cells_per_unit_q12 =
                static_cast<std::int32_t>(std::lround(4096 * 16 / (2 * std::ldexp(x_half_q20, -20))));
        });
    };
    EXPECT_EQ(with_x_half(1 << 20), "valid");
    EXPECT_EQ(with_x_half((2 << 20) + (1 << 16) - 1), "valid");
    EXPECT_THAT(with_x_half((1 << 20) - 1), HasSubstr("half width along x"));
    EXPECT_THAT(with_x_half((2 << 20) + (1 << 16)), HasSubstr("half width along x"));

    EXPECT_THAT(ring([](Ring& r) { r.u_cells_per_unit_q12 += 3; }), HasSubstr("contradict"));
    EXPECT_THAT(ring([](Ring& r) { r.x_cells_per_unit_q12 -= 3; }), HasSubstr("contradict"));
    EXPECT_THAT(ring([](Ring& r) { r.x_cells_per_unit_q12 = 0; }), HasSubstr("contradict"));
}

TEST(ValidateObject, EveryViewIsInOneRing) {
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.rings[0].views[3] = 8; }), HasSubstr("view 8 does not exist"));
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.rings[0].views[3] = 2; }),
                HasSubstr("view 2 is in a ring already"));
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.views[4].lines.pop_back(); }), HasSubstr("one line per plane"));
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.rings[0].views.clear(); }), HasSubstr("no views"));
    EXPECT_THAT(error_after([](RaySpaceObject& o) {
                    o.rig_json.clear();
                    o.views.push_back(o.views.back());
                    o.images.push_back(o.images.back());
                }),
                HasSubstr("view 8 belongs to no ring"));
    test::SmallObjectOptions two;
    two.rings = 2;
    RaySpaceObject object = small_object(two);
    EXPECT_TRUE(validate_object(object, "O").ok());
    object.rings[0].cells[0] = 8;  // a view of the other ring
    EXPECT_THAT(validate_object(object, "O").error().message,
                HasSubstr("ring 0: plane 0, row 0 of its map names view 8"));
}

TEST(ValidateObject, CellsNameViewsThatLookAtThem) {
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.rings[0].cells.pop_back(); }), HasSubstr("as many cells"));
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.rings[0].cells.back() = 4096; }),
                HasSubstr("plane 3, row 15 of its map names view 4096, which is not one of the ring's"));
    EXPECT_THAT(error_after([](RaySpaceObject& o) {
                    Ring& ring = o.rings[0];
                    const std::uint16_t view = ring.cells[0];
                    ASSERT_NE(view, kNoImage);
                    o.views[view].lines[0] = {-(1 << 20), 0, 0, 0};
                }),
                HasSubstr("which looks away from it"));
}

TEST(ValidateObject, ImagesAreWholeOrAbsent) {
    EXPECT_EQ(error_after([](RaySpaceObject& o) { o.images[1] = {}; }), "valid");
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.images[1].v = {}; }), HasSubstr("image 1: its planes"));
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.images[1].a = Image<std::uint8_t>(12, 9); }),
                HasSubstr("image 1: its planes"));
    EXPECT_THAT(error_after([](RaySpaceObject& o) { o.images[1].y = {}; }), HasSubstr("image 1: its planes"));
}

}  // namespace
