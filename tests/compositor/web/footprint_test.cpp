// Footprint of an object for its contact shadow (compositor/web/view/footprint.hpp).

#include "compositor/web/view/footprint.hpp"
#include "tests/support/small_shape.hpp"

#include <gtest/gtest.h>

namespace rs::web {
namespace {

RaySpaceObject balls() {  // centres (0.1, 0, -0.15) and (0.2, 0.1, 0.6), radii 0.7 and 0.3
    RaySpaceObject object = test::small_object();
    object.rings[0].shape = test::small_shape(object, 0, {.p_cells = 81, .bands = 71, .lines = {4}});
    object.foot_q20.reset();
    return object;
}

int clearance_at(const Footprint& print, double x, double z) {
    const auto cell = [](double at) { return static_cast<std::size_t>((at + 1) * (Footprint::kSide / 2)); };
    return print.clearance[cell(z) * Footprint::kSide + cell(x)];
}

TEST(Footprint, ShowsTheLowestSurfaces) {
    const Footprint print = footprint(balls());
    EXPECT_NEAR(print.ground, -0.7, 0.08);
    EXPECT_LT(clearance_at(print, 0.1, -0.15), 0.3 * Footprint::kPerRadius);
    EXPECT_NEAR(clearance_at(print, 0.2, 0.82), 0.7 * Footprint::kPerRadius, 0.2 * Footprint::kPerRadius);
    EXPECT_EQ(clearance_at(print, -0.9, -0.9), Footprint::kNone);
    EXPECT_EQ(clearance_at(print, 0.95, 0), Footprint::kNone);
}

TEST(Footprint, StandsOnTheKnownGround) {
    RaySpaceObject object = balls();
    object.foot_q20 = -(1 << 20);
    const Footprint print = footprint(object);
    EXPECT_EQ(print.ground, -1);
    EXPECT_GT(clearance_at(print, 0.1, -0.15), 0.25 * Footprint::kPerRadius) << "it floats by 0.3";
}

TEST(Footprint, IsADiscWithoutAShapeMap) {
    const Footprint print = footprint(test::small_object());
    EXPECT_EQ(clearance_at(print, 0, 0), 0);
    EXPECT_EQ(clearance_at(print, 0.9, 0), Footprint::kNone);
}

}  // namespace
}  // namespace rs::web
