// Tests of the effective depth (engine/RECONSTRUCTION.md, section 6) against the geometry that it stands for.
#include "engine/core/definition/effective_depth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rs::engine {
namespace {

ShapeMap shape_of(double distance, double low, double step) {
    ShapeMap shape;
    shape.reference_distance_q20 = static_cast<std::int32_t>(std::lround(std::ldexp(distance, 20)));
    shape.depth_low_q20 = static_cast<std::int32_t>(std::lround(std::ldexp(low, 20)));
    shape.depth_step_q24 = static_cast<std::int32_t>(std::lround(std::ldexp(step, 24)));
    return shape;
}

// A ray crosses the vertical line at the axis at height 0 with a slope of 1; the reference viewpoint is at height 0.
// The reference ray through the ray's point at distance s crosses the line at s D / (D + s).
double height_of_reference_ray(double distance, double s) {
    const double from_viewpoint = distance + s;
    return s * distance / from_viewpoint;
}

TEST(EffectiveDepth, IsTheHeightOfTheReferenceRay) {
    for (const double distance : {1.6, 2.0, 3.0, 6.0, 100.0}) {
        const double low = std::max(-1.0, -distance / 2);
        const double step = 2.0 / 255;
        const EffectiveDepth depths(shape_of(distance, low, step));
        for (int d = 0; d < EffectiveDepth::kDepths; ++d) {
            const double expected = height_of_reference_ray(distance, low + d * step) / step * 8;
            // low and the quotient are rounded down to eighths of a step; near the viewpoint the first counts fourfold.
            EXPECT_NEAR(depths.at(d), expected, 5) << distance << " " << d;
        }
    }
}

TEST(EffectiveDepth, IsTheDepthItselfForADistantViewpoint) {
    const EffectiveDepth depths(shape_of(2000, -1, 2.0 / 256));
    for (int d = 0; d < EffectiveDepth::kDepths; ++d) EXPECT_NEAR(depths.at(d), 8 * (d - 128), 1);
}

TEST(EffectiveDepth, DepthsBehindTheLastCountAsTheLast) {
    const EffectiveDepth depths(shape_of(3, -1, 2.0 / 255));
    EXPECT_LT(depths.at(254), depths.at(255));
    EXPECT_EQ(depths.at(256), depths.at(255));
    EXPECT_EQ(depths.at(319), depths.at(255));
    const auto table = depths.table();
    for (int d = 0; d < EffectiveDepth::kDepths; ++d) EXPECT_EQ(table[static_cast<std::size_t>(d)], depths.at(d));
}

// All shape maps that validate_object() accepts.
TEST(EffectiveDepth, NeverDecreasesWithinItsBounds) {
    const unsigned seed = std::random_device{}();
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto in = [&](std::int32_t low, std::int32_t high) {
        return std::uniform_int_distribution<std::int32_t>(low, high)(random);
    };
    for (int round = 0; round < 2000; ++round) {
        ShapeMap shape;
        shape.reference_distance_q20 = (1 << 20) + 1 + (in(0, 1) == 0 ? in(0, 1 << 20) : in(0, 255 << 20));
        shape.depth_low_q20 = in(-(1 << 21) - (1 << 16), (1 << 21) + (1 << 16));
        shape.depth_step_q24 = in(0, 1) == 0 ? in(1, 1 << 18) : in(1, 100);
        const EffectiveDepth depths(shape);
        for (int d = 0; d < EffectiveDepth::kDepths; ++d) {
            ASSERT_LE(std::abs(depths.at(d)), EffectiveDepth::kMax_q3);
            if (d > 0) {
                ASSERT_GE(depths.at(d), depths.at(d - 1)) << d;
            }
        }
    }
}

}  // namespace
}  // namespace rs::engine
