// Points of the surface that pixels show (compositor/web/view/surface_point.hpp).

#include "compositor/web/view/surface_point.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/support/small_shape.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace rs::web {
namespace {

ObjectView view_of_balls() {
    RaySpaceObject object = test::small_object();
    object.rings[0].shape = test::small_shape(object, 0, {.p_cells = 81, .bands = 71, .lines = {4}});
    for (PlanarImage& image : object.images) {
        for (std::uint8_t& alpha : image.a.pixels()) alpha = 255;
    }
    const test::TemporaryFolder folder;
    EXPECT_TRUE(write_object(folder / "thing.rso", object).ok());
    return ObjectView::open(read_file(folder / "thing.rso", 1U << 24).value(), "thing", 3).value();
}

// The ball with the centre (0.1, 0, -0.15) and the radius 0.7, level and from above.
TEST(SurfacePoint, IsOnTheSurfaceUnderThePixel) {
    const ObjectView object = view_of_balls();
    const glm::dvec3 centre(0.1, 0, -0.15);
    for (const double elevation : {0.0, 0.2}) {
        const OrbitView view{300, 200, kPi, elevation, 3.5};  // from behind: the other ball is hidden
        const Camera camera = object.camera_of(view);
        const glm::dvec3 pixel = camera.project(centre + 0.7 * glm::normalize(camera.centre() - centre));
        const auto found = surface_point(object, view, pixel.x, pixel.y);
        ASSERT_TRUE(found);
        EXPECT_NEAR(glm::length(found->position - centre), 0.7, 0.06);
        EXPECT_NEAR(glm::length(found->normal), 1, 1e-9);
        EXPECT_GT(glm::dot(found->normal, glm::normalize(camera.centre() - centre)), 0.8);
        const glm::dvec3 back = camera.project(found->position);
        EXPECT_NEAR(back.x, pixel.x, 0.51);
        EXPECT_NEAR(back.y, pixel.y, 0.51);
    }
}

TEST(SurfacePoint, IsMissingBesideTheObject) {
    EXPECT_FALSE(surface_point(view_of_balls(), {300, 200, 0, 0, 3.5}, 3, 3));
}

}  // namespace
}  // namespace rs::web
