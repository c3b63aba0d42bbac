#include "engine/core/definition/ring_choice.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/ring_axes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace rs::engine {
namespace {

Ring ring_at(double elevation_deg) {
    Ring ring;
    ring.elevation_udeg = static_cast<std::int32_t>(std::lround(elevation_deg * 1e6));
    ring.planes = 1;
    ring.views = {0, 1};
    return ring;
}

// An arc of views at these azimuths about an axis across the object's, seen from above.
Ring arc_above(double elevation_deg, const std::vector<double>& azimuths_deg) {
    Ring ring = ring_at(elevation_deg);
    ring.rotation =
        ring_rotation(glm::transpose(glm::dmat3(glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0))));
    ring.views.assign(azimuths_deg.size(), 0);
    ring.shape.reference_distance_q20 = 3 << 20;
    ring.shape.bands = 1;
    for (std::size_t n = 0; n < azimuths_deg.size(); ++n) {
        ring.shape.gaps.push_back({static_cast<std::uint16_t>(n + 1 < azimuths_deg.size() ? 1 : 0), 0});
        NormalLine line;
        line.a_q20 = static_cast<std::int32_t>(std::ldexp(3 * std::sin(radians(azimuths_deg[n])), 20));
        line.c_q20 = static_cast<std::int32_t>(std::ldexp(3 * std::cos(radians(azimuths_deg[n])), 20));
        ring.shape.normal_lines.push_back(line);
    }
    return ring;
}

glm::dvec3 from(double elevation_deg, double distance = 3) {
    const double elevation = radians(elevation_deg);
    return distance * glm::dvec3(0, std::sin(elevation), std::cos(elevation));
}

TEST(RingChoice, OneRingIsNeverMixed) {
    RaySpaceObject object;
    object.rings = {ring_at(20)};
    EXPECT_EQ(choose_rings(object, from(70)).second, -1);
}

TEST(RingChoice, WeightsAreContinuousFromRingToRing) {
    RaySpaceObject object;
    object.rings = {ring_at(0), ring_at(20), ring_at(30)};
    double before = 0;  // weight of ring 1
    for (double elevation = 0; elevation <= 30; elevation += 0.25) {
        const RingChoice choice = choose_rings(object, from(elevation));
        const int of_first = choice.nearest == 1 ? 256 - choice.weight_q8 : choice.second == 1 ? choice.weight_q8 : 0;
        EXPECT_LE(choice.weight_q8, 128);
        EXPECT_LE(std::abs(of_first - before), 7) << elevation;
        before = of_first;
    }
    EXPECT_EQ(choose_rings(object, from(20)).second, -1);
    EXPECT_EQ(choose_rings(object, from(5)).weight_q8, 64);
}

TEST(RingChoice, BeyondTheOutermostRingItAloneIsUsed) {
    RaySpaceObject object;
    object.rings = {ring_at(0), ring_at(20)};
    for (const double elevation : {-30, -1, 21, 60}) EXPECT_EQ(choose_rings(object, from(elevation)).second, -1);
}

TEST(RingChoice, ViewsFromAboveComeFromTheCap) {
    RaySpaceObject object;
    object.rings = {ring_at(0), ring_at(20), arc_above(0, {-40, -20, 0, 20, 40})};
    EXPECT_EQ(choose_rings(object, from(85)).nearest, 2);
    EXPECT_EQ(choose_rings(object, from(25)).nearest, 1);
}

TEST(RingChoice, ArcsAreUsedWhereTheirViewsCoverAllRays) {
    RaySpaceObject object;
    object.rings = {ring_at(40), arc_above(0, {-30, -15, 0, 15, 30})};
    // The arc ends at an elevation of 60 degrees. From farther away than its cameras, the object's edge is seen along
    // rays beside it.
    EXPECT_EQ(choose_rings(object, from(61)).nearest, 1);
    EXPECT_EQ(choose_rings(object, from(52)).nearest, 1);
    EXPECT_EQ(choose_rings(object, from(52, 100)).nearest, 0);
    EXPECT_EQ(choose_rings(object, from(45)).nearest, 0);
}

TEST(RingChoice, ArcsTakeOverBeyondTheHighestRing) {
    RaySpaceObject object;
    const std::vector<double> azimuths_deg = {-60, -40, -20, 0, 20, 40, 60};
    object.rings = {ring_at(40), ring_at(50), arc_above(0, azimuths_deg), arc_above(10, azimuths_deg)};
    // The arcs have views at elevations from 30 degrees on, which are not used between and at the rings.
    EXPECT_EQ(choose_rings(object, from(50)).second, -1);
    EXPECT_EQ(choose_rings(object, from(46)).second, 0);
    EXPECT_EQ(choose_rings(object, from(60)).nearest, 2);
    EXPECT_EQ(choose_rings(object, from(60)).second, -1);
    int before = 0;  // weight of the arc
    for (double elevation = 40; elevation <= 65; elevation += 0.25) {
        const RingChoice choice = choose_rings(object, from(elevation));
        const int of_arc = choice.nearest == 2 ? 256 - choice.weight_q8 : choice.second == 2 ? choice.weight_q8 : 0;
        EXPECT_LE(std::abs(of_arc - before), 7) << elevation;
        before = of_arc;
    }
}

}  // namespace
}  // namespace rs::engine
