// Allowed depths of pixels and their costs.

#include "encode/raymap/cost_volume.hpp"

#include "encode/raymap/semi_global.hpp"
#include "encode/raymap/silhouettes/visual_hull.hpp"
#include "tests/encode/raymap/drawn_views.hpp"
#include "tests/encode/raymap/striped_ball.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rs::encode {
namespace {

const DepthRange kRange{-1.03, 2.06 / 127, 128};

// All levels are allowed, since the hull excludes none.
CostVolume every_level(const WorkView& view) {
    return create_volume(SampledHull(VisualHull({}, 1), 0.05), view, kRange);
}

std::vector<DepthView> without_depths(const std::vector<WorkView>& views) {
    std::vector<DepthView> found;
    for (const WorkView& view : views) found.push_back({view, {}});
    return found;
}

TEST(CostVolume, HasTheLevelsThatTheHullAllows) {
    const std::vector<WorkView> views = drawn_views(drawn_ring(12, 3));
    const SampledHull hull(VisualHull(pointers(views), 1), 0.004);
    WorkView view = views[0];
    // A corner of the image outside of every silhouette.
    for (int row = 0; row < 4; ++row) view.columns(row, 0) = {1, 2, 3, 255};
    const CostVolume volume = create_volume(hull, view, kRange);
    int between = 0;
    std::size_t levels = 0;
    for (int column = volume.box.left; column < volume.box.right; ++column) {
        const HorizontalRay ray = view.ray_of(column + 0.5);
        for (int row = volume.box.top; row < volume.box.bottom; ++row) {
            const PixelLevels& pixel = volume.of(column, row);
            ASSERT_EQ(pixel.count != 0, view.at(column, row).a != 0);
            levels += pixel.count;
            bool any = false;
            for (int level = 0; level < kRange.count; ++level) {
                const double depth = kRange.at(level);
                const double y = view.height_of(row + 0.5, ray.axial_at(depth));
                const auto heights = hull.heights_above(ray.place_at(depth));
                const bool inside = std::any_of(heights.begin(), heights.end(),
                                                [&](const Interval& i) { return y >= i.low && y <= i.high; });
                const int n = level - pixel.first;
                const bool has = n >= 0 && n < pixel.count;
                any |= inside;
                if (pixel.count == 0) continue;
                ASSERT_TRUE(has || !inside);
                if (!has) continue;
                ASSERT_EQ(volume.costs[pixel.begin + static_cast<std::uint32_t>(n)], inside ? 0 : kOutsideCost);
                between += inside ? 0 : 1;
            }
            EXPECT_TRUE(any || pixel.count == 0 || pixel.count == kRange.count) << "nothing is allowed";
        }
    }
    EXPECT_EQ(volume.costs.size(), levels);
    EXPECT_EQ(volume.of(0, 0).count, kRange.count);
    EXPECT_GT(between, 4 * kRange.count) << "the small balls stand before the big one";
}

TEST(CostVolume, OfAMaskOnlyItsPixelsAreSearched) {
    const std::vector<WorkView> views = drawn_views(drawn_ring(12, 3));
    const SampledHull hull(VisualHull(pointers(views), 1), 0.01);
    const WorkView& view = views[0];
    Image<std::uint8_t> only(view.columns.width(), view.columns.height());
    for (int row = 0; row < view.height / 2; ++row) {
        for (int column = 0; column < view.width; column += 3) only(row, column) = 255;
    }
    const CostVolume all = create_volume(hull, view, kRange);
    const CostVolume some = create_volume(hull, view, kRange, &only);
    int searched = 0;
    for (int column = all.box.left; column < all.box.right; ++column) {
        for (int row = all.box.top; row < all.box.bottom; ++row) {
            const PixelLevels& pixel = some.of(column, row);
            const PixelLevels& wanted = all.of(column, row);
            ASSERT_EQ(pixel.count, only(row, column) != 0 ? wanted.count : 0);
            if (pixel.count == 0) continue;
            ++searched;
            ASSERT_EQ(pixel.first, wanted.first);
            ASSERT_TRUE(std::equal(some.costs.begin() + pixel.begin, some.costs.begin() + pixel.begin + pixel.count,
                                   all.costs.begin() + wanted.begin));
        }
    }
    EXPECT_GT(searched, 50);
}

TEST(CostVolume, ColoursFindTheDepthOfTheBalls) {
    const std::vector<WorkView> views = drawn_views(drawn_ring(60));
    const std::vector<DepthView> all = without_depths(views);
    const SampledHull hull(VisualHull(pointers(views), 1), 0.005);
    CostVolume costs = create_volume(hull, views[0], kRange);
    match_colours(costs, views[0], {{&all[1], &all[59]}, {}}, kRange);
    const Image<float> levels = semi_global_levels(views[0], costs, {});
    // The balls' shading rotates with the viewer, so that colours agree at the middle of the big ball, which is on the
    // axis.
    EXPECT_NEAR(kRange.at(static_cast<double>(levels(50, 64))), 0, 0.08);
    EXPECT_TRUE(std::isnan(levels(0, 0)));
}

// A horizontal view of the striped ball.
DepthView striped_view(double azimuth_deg, double elevation_deg) {
    Camera camera = drawn_ring(1, azimuth_deg, 3.5 * std::cos(radians(elevation_deg))).views[0].camera;
    camera.world_from_camera[3].y = 3.5 * std::sin(radians(elevation_deg));
    DepthView made{make_work_view(camera, striped_ball(camera), 1), {}};
    made.depth = Image<float>(made.view.height, made.view.width, kNoDepth);
    for (int column = 0; column < made.view.width; ++column) {
        for (int row = 0; row < made.view.height; ++row) {
            if (made.view.at(column, row).a == 0) continue;
            made.depth(row, column) = static_cast<float>(ball_depth(made.view, column, row));
        }
    }
    return made;
}

TEST(CostVolume, LevelStripesHaveADepthOnlyAcrossRings) {
    const WorkView view = striped_view(0, 10).view;
    const DepthView left = striped_view(-6, 10);
    const DepthView right = striped_view(6, 10);
    const DepthView below = striped_view(1, 4);
    const DepthView above = striped_view(-2, 16);
    constexpr int kColumn = 64;
    // The largest distance from the ball's surface of a depth whose cost is close to the minimum.
    const auto doubt = [&](const Neighbours& neighbours, int row) {
        CostVolume volume = every_level(view);
        match_colours(volume, view, neighbours, kRange);
        const std::uint8_t* const of = volume.costs.data() + volume.of(kColumn, row).begin;
        const int least = *std::min_element(of, of + kRange.count);
        double farthest = 0;
        for (int level = 0; level < kRange.count; ++level) {
            if (of[level] > least + 2) continue;
            farthest = std::max(farthest, std::abs(kRange.at(level) - ball_depth(view, kColumn, row)));
        }
        return farthest;
    };
    for (const int row : {50, 57, 64}) {
        EXPECT_GT(doubt({{&left, &right}, {}}, row), 0.3) << row;
        EXPECT_LT(doubt({{&left, &right}, {&below, &above}}, row), 0.15) << row;
        EXPECT_LT(doubt({{}, {&below}}, row), 0.15) << row;
    }
}

// Stripes that look equal in all images do not determine depth; the neighbours' depth maps do.
TEST(CostVolume, WhatNeighboursShowTellsTheDepth) {
    const WorkView view = striped_view(0, 10).view;
    const DepthView left = striped_view(-6, 10);
    DepthView right = striped_view(6, 10);
    // One neighbour's depth is wrong.
    for (float& depth : right.depth.pixels()) depth += 0.5F;
    DepthView blind = left;
    for (float& depth : blind.depth.pixels()) depth = kNoDepth;
    constexpr int kColumn = 60;
    for (const int row : {50, 57, 70}) {
        const auto costs = [&](const Neighbours& neighbours) {
            CostVolume volume = every_level(view);
            add_inconsistency(volume, view, neighbours, kRange);
            const auto begin = volume.costs.begin() + volume.of(kColumn, row).begin;
            return std::vector<int>(begin, begin + kRange.count);
        };
        const double truth = kRange.level_of(ball_depth(view, kColumn, row));
        const auto at_truth = static_cast<std::size_t>(std::lround(truth));
        const std::vector<int> of_left = costs({{&left}, {}});
        const auto least = std::min_element(of_left.begin(), of_left.end()) - of_left.begin();
        EXPECT_NEAR(static_cast<double>(least), truth, 2) << row;
        EXPECT_EQ(of_left[at_truth + 30], kMaxCost) << row;
        EXPECT_EQ(of_left[at_truth - 15], kMaxCost) << row;
        for (const Neighbours& both : {Neighbours{{&left, &right}, {}}, Neighbours{{&right}, {&left}}}) {
            EXPECT_LT(costs(both)[at_truth], 10) << row;
            EXPECT_EQ(costs(both).front(), kMaxCost) << row;
        }
        EXPECT_GT(costs({{&right}, {}})[at_truth], 50) << row;
        for (const int cost : costs({{&blind}, {}})) EXPECT_EQ(cost, 0);
    }
}

}  // namespace
}  // namespace rs::encode
