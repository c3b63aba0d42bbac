// Preparation of working views for depth estimation.

#include "encode/raymap/silhouettes/work_view.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/rig.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace rs::encode {
namespace {

constexpr int kWorkWidth = 128;
constexpr int kWorkHeight = 112;

Rig cameras_around(int count) {
    return make_ring({.count = count,
                      .distance = 3.5,
                      .fl_px = 180,
                      .width = kWorkWidth,
                      .height = kWorkHeight,
                      .first_rad = radians(11)});
}

TEST(WorkView, PixelsGoToPointsAndBack) {
    const Rig rig = cameras_around(7);
    for (const RigView& each : rig.views) {
        const WorkView view = make_work_view(each.camera, Image<Rgba8>(kWorkWidth, kWorkHeight), 1);
        for (const double column : {3.5, 64.5, 120.5}) {
            const HorizontalRay ray = view.ray_of(column);
            EXPECT_NEAR(glm::dot(ray.foot, ray.along), 0, 1e-12);
            for (const double depth : {-0.8, 0.0, 0.7}) {
                const ProjectedColumn seen = view.see(ray.foot + depth * ray.along);
                EXPECT_NEAR(seen.column, column, 1e-9);
                EXPECT_NEAR(seen.axial, (ray.to_foot + depth) / ray.horizontal_per_axial, 1e-12);
                EXPECT_NEAR(view.row_of(view.height_of(17.25, seen.axial), seen.axial), 17.25, 1e-9);
            }
        }
    }
}

TEST(WorkView, ReductionAveragesByAlpha) {
    Image<Rgba8> image(5, 4);
    image(0, 0) = {200, 100, 0, 255};
    image(1, 0) = {0, 0, 200, 85};
    const WorkView view = make_work_view(cameras_around(1).views[0].camera, image, 2);
    EXPECT_EQ(view.width, 2);
    EXPECT_EQ(view.height, 2);
    EXPECT_EQ(view.at(0, 0), (Rgba8{150, 75, 50, 85}));
    EXPECT_EQ(view.at(1, 1), Rgba8{});
}

// Coarse stripes that are brighter than in another image, as with gloss.
TEST(WorkView, WeakenedShadingKeepsDetail) {
    const auto view_of = [](int gloss) {
        WorkView view;
        view.width = view.height = 40;
        view.columns = Image<Rgba8>(40, 40);
        for (int y = 0; y < 40; ++y) {
            for (int x = 5; x < 40; ++x) {
                const auto value = static_cast<std::uint8_t>(90 + gloss + ((x / 2 + y / 2) % 2 == 0 ? 20 : -20));
                view.columns(x, y) = {value, value, value, static_cast<std::uint8_t>(x == 5 ? 1 : 255)};
            }
        }
        attenuate_shading(view);
        return view.columns;
    };
    const Image<Rgba8> dull = view_of(0);
    const Image<Rgba8> glossy = view_of(60);
    for (int y = 0; y < 40; ++y) {
        EXPECT_EQ(dull(4, y), Rgba8{});
        EXPECT_EQ(dull(5, y).a, 1);
        for (int x = 6; x < 40; ++x) {
            EXPECT_NEAR(glossy(x, y).g - dull(x, y).g, 15, 1) << x << " " << y;  // a quarter of 60
            EXPECT_EQ(dull(x, y).a, 255);
        }
        // Two pixels farther the pattern is inverted.
        for (int x = 12; x < 30; ++x) EXPECT_NEAR(std::abs(dull(x + 2, y).g - dull(x, y).g), 40, 5) << x << " " << y;
    }
}

}  // namespace
}  // namespace rs::encode
