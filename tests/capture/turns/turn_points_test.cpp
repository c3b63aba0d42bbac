#include "capture/turns/turn_points.hpp"

#include "tests/capture/turns/turn_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rs::capture {
namespace {

struct MatchedPoints {
    std::vector<glm::dvec3> first, second;
    std::vector<PointPair> pairs;
};

// `right` right and `wrong` wrong pairs.
MatchedPoints matched_points(const TurnPlacement& placement, std::size_t right, std::size_t wrong) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> side(-0.3, 0.3);
    MatchedPoints points;
    for (std::size_t i = 0; i < right + wrong; ++i) {
        const glm::dvec3 p(side(random), side(random), side(random));
        const glm::dvec3 q(side(random), side(random), side(random));
        points.first.push_back(p);
        points.second.push_back(placement.turn_from_common(i < right ? p : q));
        points.pairs.push_back({i, i});
    }
    return points;
}

TEST(TurnPoints, FindThePlacementAmongWrongPairs) {
    const TurnPlacement truth = upright_placement(radians(-75), 1.3, 0.4);
    const MatchedPoints points = matched_points(truth, 40, 120);
    const auto found = register_points(points.first, points.second, points.pairs);
    ASSERT_TRUE(found);
    EXPECT_GE(found->pairs.size(), 40U);
    EXPECT_LT(found->pairs.size(), 45U);
    EXPECT_NEAR(degrees(azimuth_rad(found->placement)), -75, 0.5);
    EXPECT_NEAR(found->placement.distance, 1.3, 0.02);
    EXPECT_NEAR(found->placement.offset.y, -0.4, 0.02);
}

// The object on its side.
TurnPlacement lying_placement() {
    TurnPlacement placement = upright_placement(radians(40), 1.2, 0.1);
    const double c = std::cos(radians(97)), s = std::sin(radians(97));
    placement.rotation =
        glm::dmat3(glm::dvec3(c, s, 0), glm::dvec3(-s, c, 0), glm::dvec3(0, 0, 1)) * placement.rotation;
    placement.offset += glm::dvec3(0.05, -0.02, 0.03);
    return placement;
}

TEST(TurnPoints, FindAnotherOrientationAmongWrongPairs) {
    const TurnPlacement truth = lying_placement();
    const MatchedPoints points = matched_points(truth, 40, 120);
    const auto found = register_reoriented_points(points.first, points.second, points.pairs);
    ASSERT_TRUE(found);
    EXPECT_GE(found->pairs.size(), 40U);
    EXPECT_LT(found->pairs.size(), 45U);
    EXPECT_NEAR(axis_tilt_deg(found->placement), 97, 0.5);
    EXPECT_FALSE(found->placement.is_upright());
    EXPECT_NEAR(found->placement.distance, 1.2, 0.02);
    for (const glm::dvec3& p : points.first) {
        const glm::dvec3 off = found->placement.turn_from_common(p) - truth.turn_from_common(p);
        EXPECT_LT(glm::length(off), 0.01);
    }
    EXPECT_FALSE(register_points(points.first, points.second, points.pairs)) << "it does not stand";
}

TEST(TurnPoints, WrongPairsAloneGiveNoPlacement) {
    const MatchedPoints points = matched_points({}, 0, 100);
    EXPECT_FALSE(register_points(points.first, points.second, points.pairs));
    EXPECT_FALSE(register_reoriented_points(points.first, points.second, points.pairs));
}

TEST(TurnPoints, AnUprightTurnIsNotReoriented) {
    const MatchedPoints points = matched_points(upright_placement(radians(-75), 1.3, 0.4), 40, 20);
    EXPECT_FALSE(register_reoriented_points(points.first, points.second, points.pairs));
}

}  // namespace
}  // namespace rs::capture
