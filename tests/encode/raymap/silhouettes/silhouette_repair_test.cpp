// Finds parts that masks lack, from a ball with known depths.

#include "encode/raymap/silhouettes/silhouette_repair.hpp"

#include "tests/encode/raymap/drawn_views.hpp"
#include "tests/encode/raymap/striped_ball.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::encode {
namespace {

constexpr int kViews = 12;
constexpr double kTolerance = 0.02;

// A ring about the ball with ground-truth depths; one image lacks a part.
class SilhouetteRepair : public testing::Test {
protected:
    static constexpr int kBitten = 6;
    // The missing part of one image: a strip at the ball's left rim.
    static constexpr int kLeft = 20, kRight = 32, kTop = 40, kBottom = 64;

    SilhouetteRepair() {
        Rig rig = drawn_ring(kViews);
        rig.object_radius = 1;
        for (const RigView& each : rig.views) {
            DepthView view{make_work_view(each.camera, striped_ball(each.camera), 1), {}};
            view.depth = Image<float>(view.view.height, view.view.width, kNoDepth);
            for (int column = 0; column < view.view.width; ++column) {
                for (int row = 0; row < view.view.height; ++row) {
                    if (view.view.at(column, row).a == 0) continue;
                    view.depth(row, column) = static_cast<float>(ball_depth(view.view, column, row));
                }
            }
            ring_.push_back(std::move(view));
        }
    }

    void bite() {
        WorkView& view = ring_[kBitten].view;
        for (int column = kLeft; column < kRight; ++column) {
            for (int row = kTop; row < kBottom; ++row) {
                bitten_ += view.at(column, row).a >= kInside ? 1 : 0;
                view.columns(row, column) = {};
                ring_[kBitten].depth(row, column) = kNoDepth;
            }
        }
    }

    [[nodiscard]] std::vector<const WorkView*> silhouettes() const {
        std::vector<const WorkView*> views;
        for (const DepthView& each : ring_) views.push_back(&each.view);
        return views;
    }

    [[nodiscard]] std::vector<const DepthView*> beside(int n) const {
        return {&ring_[static_cast<std::size_t>((n + kViews - 1) % kViews)],
                &ring_[static_cast<std::size_t>((n + 1) % kViews)]};
    }

    [[nodiscard]] std::vector<std::vector<RuledOutPoint>> points(int searched_margin = 16) const {
        const SampledHull hull(VisualHull(silhouettes(), 1), 0.01);
        const SampledHull searched(VisualHull(silhouettes(), searched_margin), 0.01);
        std::vector<std::vector<RuledOutPoint>> found;
        for (int n = 0; n < kViews; ++n) {
            found.push_back(find_ruled_out(ring_[static_cast<std::size_t>(n)], beside(n), kTolerance, searched, hull));
        }
        return found;
    }

    static std::size_t count_of(const std::vector<std::vector<RuledOutPoint>>& points) {
        std::size_t count = 0;
        for (const auto& each : points) count += each.size();
        return count;
    }

    static int count_of(const Image<float>& missing) {
        return static_cast<int>(
            std::ranges::count_if(missing.pixels(), [](float depth) { return !std::isnan(depth); }));
    }

    std::vector<DepthView> ring_;
    int bitten_ = 0;
};

TEST_F(SilhouetteRepair, NothingIsMissingWhereSilhouettesAreWhole) {
    EXPECT_EQ(count_of(points()), 0U);
}

TEST_F(SilhouetteRepair, WhatOneImageLacksIsFoundThereAlone) {
    bite();
    ASSERT_GT(bitten_, 100);
    const auto found = points();
    for (std::size_t n = 0; n < kViews; ++n) {
        const Image<float> missing = missing_depths(ring_[n].view, found);
        if (n != kBitten) {
            EXPECT_EQ(count_of(missing), 0) << "image " << n;
            continue;
        }
        int near = 0;  // pixels that show the near side; a few do not
        // Pixels next to the object may belong to its rim.
        EXPECT_GT(count_of(missing), bitten_ / 2);
        for (int column = 0; column < missing.height(); ++column) {
            for (int row = 0; row < missing.width(); ++row) {
                if (std::isnan(missing(row, column))) continue;
                EXPECT_TRUE(column >= kLeft && column < kRight && row >= kTop && row < kBottom)
                    << column << ", " << row;
                const double near_side = ball_depth(ring_[n].view, column, row);
                near += std::abs(static_cast<double>(missing(row, column)) - near_side) < 0.1 ? 1 : 0;
            }
        }
        EXPECT_GT(near, count_of(missing) * 3 / 4);
    }
}

TEST_F(SilhouetteRepair, PointsThatOneNeighbourDoesNotShowSayNothing) {
    bite();
    const auto agreed = points();
    for (std::size_t n = 0; n < kViews; n += 4) {
        for (float& depth : ring_[n].depth.pixels()) depth += 0.5F;
    }
    const auto left = points();
    std::size_t before = 0, after = 0;  // for images with one displaced neighbour
    for (std::size_t n = 1; n < kViews; n += 2) {
        before += agreed[n].size();
        after += left[n].size();
    }
    EXPECT_GT(before, 50U);
    EXPECT_LT(after, before / 10);  // by chance
    EXPECT_EQ(left[2].size() + left[10].size(), agreed[2].size() + agreed[10].size());
}

TEST_F(SilhouetteRepair, OnlyWhatWasSearchedIsFound) {
    bite();
    EXPECT_GT(count_of(points(8)), count_of(points(2)));
    EXPECT_EQ(count_of(points(1)), 0U);
}

TEST_F(SilhouetteRepair, AImageWithoutAnObjectLacksNothing) {
    bite();
    const auto found = points();
    WorkView empty = ring_[kBitten].view;
    for (Rgba8& pixel : empty.columns.pixels()) pixel.a = std::min<std::uint8_t>(pixel.a, kInside - 1);
    EXPECT_EQ(count_of(missing_depths(empty, found)), 0);
}

TEST_F(SilhouetteRepair, SoftPixelsSayNothing) {
    bite();
    for (DepthView& each : ring_) {
        for (Rgba8& pixel : each.view.columns.pixels()) pixel.a = std::min<std::uint8_t>(pixel.a, 200);
    }
    EXPECT_EQ(count_of(points()), 0U);
}

TEST_F(SilhouetteRepair, WhatMayLieBeforeTheObjectIsNotMissing) {
    const WorkView& view = ring_[0].view;
    const SpacePoint beside{{1.05, 0}, 0}, before{{0, 0}, 0};
    const auto missing = [&](const RuledOutPoint& point) {
        return count_of(missing_depths(view, std::vector<std::vector<RuledOutPoint>>{{point}}));
    };
    EXPECT_EQ(missing({beside, beside, beside}), 1);
    EXPECT_EQ(missing({before, beside, beside}), 0);
    EXPECT_EQ(missing({beside, before, beside}), 0);
    EXPECT_EQ(missing({beside, beside, before}), 0);
}

TEST_F(SilhouetteRepair, WhatLeavesTheFrameMayBeObject) {
    const WorkView& view = ring_[0].view;
    const auto missing_at = [&](double column) {
        const HorizontalRay ray = view.ray_of(column);
        const SpacePoint point{ray.place_at(0), 0};
        return count_of(missing_depths(view, std::vector<std::vector<RuledOutPoint>>{{{point, point, point}}}));
    };
    EXPECT_EQ(missing_at(1.5), 1);
    EXPECT_EQ(missing_at(0.5), 0);
    EXPECT_EQ(missing_at(view.width - 0.5), 0);
    EXPECT_EQ(missing_at(-3), 0);
}

TEST_F(SilhouetteRepair, FillsBlocksOfTwoAndWhatIsNextToThem) {
    WorkView& view = ring_[0].view;
    Image<float> missing(view.height / 2, view.width / 2, kNoDepth);
    missing(3, 4) = 0;  // row 3, column 4
    fill_missing(view, missing);
    for (int column = 0; column < 16; ++column) {
        for (int row = 0; row < 16; ++row) {
            const bool filled = column >= 7 && column <= 10 && row >= 5 && row <= 8;
            EXPECT_EQ(view.at(column, row).a, filled ? 255 : 0) << column << ", " << row;
        }
    }
}

TEST(HalvedView, DropsWhatIsLeftOverAndFillsUpToTheEdge) {
    const Camera camera = drawn_ring(8).views[1].camera;
    WorkView odd = make_work_view(camera, Image<Rgba8>(7, 5, {40, 80, 120, 255}), 1);
    const WorkView half = halve(odd);
    EXPECT_EQ(half.width, 3);
    EXPECT_EQ(half.height, 2);
    for (Rgba8& pixel : odd.columns.pixels()) pixel.a = 0;
    fill_missing(odd, Image<float>(2, 3, 0.0F));
    EXPECT_TRUE(std::ranges::all_of(odd.columns.pixels(), [](const Rgba8& pixel) { return pixel.a == 255; }));
    EXPECT_EQ(halve(make_work_view(camera, Image<Rgba8>(1, 1), 1)).width, 0);
}

TEST(HalvedView, SeesPointsAtHalfTheirPlaceInMeansOfFourPixels) {
    const Camera camera = drawn_ring(8).views[1].camera;
    Image<Rgba8> image(camera.width, camera.height, {40, 80, 120, 255});
    image(10, 21) = {80, 80, 120, 255};
    image(11, 20) = {0, 0, 0, 0};
    const WorkView whole = make_work_view(camera, image, 1);
    const WorkView half = halve(whole);
    EXPECT_EQ(half.width, 64);
    EXPECT_EQ(half.height, 56);
    const glm::dvec2 place(0.3, -0.2);
    EXPECT_NEAR(half.see(place).column, whole.see(place).column / 2, 1e-9);
    EXPECT_NEAR(half.row_of(0.4, 3), whole.row_of(0.4, 3) / 2, 1e-9);
    EXPECT_EQ(half.at(5, 10).r, 53);  // mean of three
    EXPECT_EQ(half.at(5, 10).a, 191);
    EXPECT_EQ(half.at(6, 10).r, 40);
}

}  // namespace
}  // namespace rs::encode
