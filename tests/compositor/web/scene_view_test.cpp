// Views of an object in a scene on a page (compositor/web/view), in the native build.

#include "compositor/web/view/scene_view.hpp"

#include "engine/core/definition/view_registers.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/support/small_shape.hpp"
#include "tests/support/temporary_folder.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rs::web {
namespace {

SceneObject open_small_object() {
    const test::TemporaryFolder folder;
    EXPECT_TRUE(write_object(folder / "thing.rso", test::small_object_with_shape()).ok());
    return std::move(SceneObject::open(read_file(folder / "thing.rso", 1U << 24).value(), "thing").value());
}

// Points of the scene that the pixels show.
std::vector<glm::dvec3> shown_points(const SceneView& shown) {
    std::vector<glm::dvec3> points;
    const glm::dmat3 screen_from_image = glm::inverse(shown.view.image_from_screen);
    for (int y = 0; y < shown.image.height(); ++y) {
        for (int x = 0; x < shown.image.width(); ++x) {
            if (!(shown.depths(x, y) > 0)) continue;
            const glm::dvec3 at = screen_from_image * glm::dvec3(x + 0.5, y + 0.5, 1);
            // w of the mapping is the depth in the image over that on the screen.
            const double w = (shown.view.image_from_screen * (at / at.z)).z;
            const double depth = shown.depths(x, y) * shown.view.units_per_rig_unit / w;
            points.push_back(shown.screen.centre() + depth * shown.screen.ray(at.x / at.z, at.y / at.z));
        }
    }
    return points;
}

TEST(SceneView, PixelsLieOnTheObjectInTheScene) {
    const SceneObject object = open_small_object();
    SceneSight sight;
    sight.world_from_node = glm::scale(glm::translate(glm::dmat4(1.0), {10, 2, -3}), glm::dvec3(0.5));
    sight.standing = false;
    sight.focal_px = 200;
    for (const glm::dvec3& towards : {glm::dvec3(0, 0, 2), glm::dvec3(2, 0.4, 0), glm::dvec3(-1.5, -0.3, -1)}) {
        sight.eye = glm::dvec3(10, 2, -3) + towards;
        SceneView shown;
        const Result<bool> seen = object.render(sight, shown);
        ASSERT_TRUE(seen) << seen.error().message;
        ASSERT_TRUE(*seen);
        const std::vector<glm::dvec3> points = shown_points(shown);
        ASSERT_GT(points.size(), 100U);
        const compositor::BoundingCylinder& bounds = object.object().bounds;
        for (const glm::dvec3& p : points) {
            const glm::dvec3 in_node = (p - glm::dvec3(10, 2, -3)) / 0.5;
            EXPECT_LT(std::hypot(in_node.x, in_node.z), bounds.radius + 0.05);
            EXPECT_GT(in_node.y, bounds.bottom - 0.05);
            EXPECT_LT(in_node.y, bounds.top + 0.05);
        }
    }
}

TEST(SceneView, StandingObjectsAreRaisedByTheirFoot) {
    const SceneObject object = open_small_object();
    const auto mean_height = [&](bool standing) {
        SceneSight sight;
        sight.standing = standing;
        sight.eye = {0, 0, 5};
        sight.focal_px = 200;
        SceneView shown;
        EXPECT_TRUE(object.render(sight, shown).value());
        double sum = 0;
        const std::vector<glm::dvec3> points = shown_points(shown);
        for (const glm::dvec3& p : points) sum += p.y;
        return sum / static_cast<double>(points.size());
    };
    EXPECT_NEAR(mean_height(true) - mean_height(false), -object.object().extent.bottom, 0.1);
}

TEST(SceneView, ResolutionFollowsTheDistanceUpToTheLimit) {
    const SceneObject object = open_small_object();
    const auto width_from = [&](double distance, int max_pixels) {
        SceneSight sight;
        sight.eye = {0, 0, distance};
        sight.focal_px = 600;
        sight.max_pixels = max_pixels;
        SceneView shown;
        EXPECT_TRUE(object.render(sight, shown).value());
        return shown.view.rectangle.width;
    };
    EXPECT_NEAR(width_from(6, 1'000'000), 2 * width_from(12, 1'000'000), 12);
    EXPECT_LE(width_from(3, 10'000), 100);
}

TEST(SceneView, SightsOutOfRangeAreRefused) {
    const SceneObject object = open_small_object();
    SceneView shown;
    SceneSight sight;
    sight.eye.x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(object.render(sight, shown));
    sight.eye = {0, 0, 5};
    sight.world_from_node = glm::dmat4(0.0);
    EXPECT_FALSE(object.render(sight, shown));
    sight.world_from_node = glm::dmat4(1.0);
    sight.focal_px = 0;
    EXPECT_FALSE(object.render(sight, shown));
}

}  // namespace
}  // namespace rs::web
