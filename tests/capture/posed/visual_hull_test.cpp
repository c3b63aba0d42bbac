#include "capture/posed/visual_hull.hpp"

#include "tests/capture/posed/posed_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace rs::capture {
namespace {

std::vector<HullView> hull_views(int count) {
    std::vector<HullView> views;
    for (const PosedCamera& posed : test::posed_cameras(count, 160, 120)) {
        const Image<Rgba8> photo = test::posed_photo(posed);
        HullView view{posed.camera, cv::Mat1b(photo.height(), photo.width(), std::uint8_t{0})};
        for (int y = 0; y < photo.height(); ++y) {
            for (int x = 0; x < photo.width(); ++x) view.mask(y, x) = photo(x, y).a >= 128 ? 255 : 0;
        }
        views.push_back(view);
    }
    return views;
}

TEST(VisualHull, BoundsTheObject) {
    const std::vector<HullView> views = hull_views(24);
    const auto target = common_target(views);
    ASSERT_TRUE(target.ok());
    EXPECT_LT(glm::length(*target - glm::dvec3(0.1, 0, 0)), 0.2);
    EXPECT_EQ(count_in_front(views, *target), 24U);
    const auto object = carve_bounding_cylinder(views, *target, {0, 1, 0});
    ASSERT_TRUE(object.ok()) << object.error().message;
    // x from -1 to 1.3, y from -1.3 to 1.3; a hull has more than the object.
    EXPECT_NEAR(object->centre.x, 0.15, 0.04);
    EXPECT_NEAR(object->centre.z, 0, 0.04);
    EXPECT_NEAR(object->radius, 1.15, 0.06);
    EXPECT_NEAR(object->height, 2.6, 0.25);
    EXPECT_TRUE(object->cameras_inside.empty());
    for (const double share : object->beyond_hull) EXPECT_LT(share, 0.02);
}

TEST(VisualHull, UnitOfLengthIsOfNoInfluence) {
    constexpr double kUnit = 1e-5;
    std::vector<HullView> views = hull_views(24);
    const auto large = carve_bounding_cylinder(views, *common_target(views), {0, 1, 0});
    for (HullView& view : views) view.camera.world_from_camera[3] *= glm::dvec4(glm::dvec3(kUnit), 1);
    const auto small = carve_bounding_cylinder(views, *common_target(views), {0, 1, 0});
    ASSERT_TRUE(large.ok() && small.ok());
    EXPECT_NEAR(small->radius / kUnit, large->radius, 1e-3);
    EXPECT_NEAR(small->height / kUnit, large->height, 1e-3);
}

TEST(VisualHull, OneMaskWithBackgroundIsOutvotedAndNamed) {
    std::vector<HullView> views = hull_views(24);
    cv::rectangle(views[3].mask, cv::Rect(0, 0, 40, 120), 255, cv::FILLED);
    const auto target = common_target(views);
    ASSERT_TRUE(target.ok());
    const auto object = carve_bounding_cylinder(views, *target, {0, 1, 0});
    ASSERT_TRUE(object.ok()) << object.error().message;
    EXPECT_NEAR(object->radius, 1.15, 0.06);
    EXPECT_GT(object->beyond_hull[3], 0.3);
    EXPECT_LT(object->beyond_hull[4], 0.02);
}

TEST(VisualHull, ParallelViewsHaveNoCommonTarget) {
    std::vector<HullView> views = hull_views(1);
    views.resize(5, views[0]);
    EXPECT_FALSE(common_target(views).ok());
}

}  // namespace
}  // namespace rs::capture
