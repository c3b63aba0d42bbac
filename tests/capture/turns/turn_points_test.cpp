#include "capture/turns/turn_points.hpp"

#include "tests/capture/turns/turn_scene.hpp"

#include <gtest/gtest.h>

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

TEST(TurnPoints, WrongPairsAloneGiveNoPlacement) {
    const MatchedPoints points = matched_points({}, 0, 100);
    EXPECT_FALSE(register_points(points.first, points.second, points.pairs));
}

}  // namespace
}  // namespace rs::capture
