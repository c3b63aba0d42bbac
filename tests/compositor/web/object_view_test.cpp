// Views of an object for a page (compositor/web/view), as the WebAssembly core renders them, in the native build.

#include "compositor/web/view/object_view.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/support/small_shape.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace rs::web {
namespace {

std::vector<std::byte> file_of(const RaySpaceObject& object) {
    const test::TemporaryFolder folder;
    EXPECT_TRUE(write_object(folder / "thing.rso", object).ok());
    return read_file(folder / "thing.rso", 1U << 24).value();
}

TEST(ObjectView, FindsTheCapturedCamerasWithoutARig) {
    RaySpaceObject object = test::small_object({.rings = 2});
    object.rig_json.clear();
    const Result<ObjectView> view = ObjectView::open(file_of(object), "thing", 3);
    ASSERT_TRUE(view) << view.error().message;
    ASSERT_EQ(view->captured().size(), 2U);
    const CapturedCamera& first = view->captured()[0];
    EXPECT_NEAR(first.distance, 3.5, 1e-4);
    EXPECT_NEAR(first.elevation_rad, 0, 1e-4);
    EXPECT_NEAR(first.azimuth_rad, 0, 1e-4);
    EXPECT_NEAR(first.target_height, 0, 1e-4);
    EXPECT_NEAR(first.tan_half_x, 1 / 2.4, 1e-4) << "fl_px is 1.2 times the width";
    EXPECT_NEAR(view->captured()[1].elevation_rad, std::atan2(0.25, 3.5), 1e-4);
}

TEST(ObjectView, FindsTheAzimuthOfTheFirstPhoto) {
    RaySpaceObject object = test::small_object();
    std::rotate(object.rings[0].views.begin(), object.rings[0].views.begin() + 3, object.rings[0].views.end());
    EXPECT_NEAR(captured_cameras(object)[0].azimuth_rad, 3 * 2 * kPi / 8, 1e-4);
}

// An orbit at the height of the target has upright cameras: the engine's own image of the same camera.
TEST(ObjectView, LevelViewsAreTheImagesOfTheEngine) {
    const RaySpaceObject object = test::small_object_with_shape();
    Result<ObjectView> view = ObjectView::open(file_of(object), "thing", 3);
    ASSERT_TRUE(view) << view.error().message;
    constexpr int kWidth = 40;
    constexpr int kHeight = 30;
    const CapturedCamera& captured = view->captured()[0];
    ASSERT_TRUE(view->render({kWidth, kHeight, 0.5, 0, captured.distance}).ok());
    const double tan_half = std::max(captured.tan_half_x, captured.tan_half_y * kWidth / kHeight);
    const double unit = object.units_per_radius;
    const glm::dvec3 eye(std::sin(0.5) * captured.distance, captured.target_height, std::cos(0.5) * captured.distance);
    const Camera camera = look_at_camera(eye * unit, glm::dvec3(0, captured.target_height, 0) * unit,
                                         2 * std::atan(tan_half), kWidth, kHeight);
    const Result<engine::Renderer> renderer = engine::Renderer::create(object);
    Image<Rgba8> expected(kWidth, kHeight);
    renderer->render(engine::prepare_view(object, camera).value(), expected);
    EXPECT_EQ(view->image(), expected);
}

// Between two rings, the engine's mix of both.
TEST(ObjectView, ViewsBetweenRingsAreMixed) {
    const RaySpaceObject object = test::small_object({.rings = 2});
    Result<ObjectView> view = ObjectView::open(file_of(object), "thing", 3);
    ASSERT_TRUE(view) << view.error().message;
    const CapturedCamera& captured = view->captured()[0];
    const OrbitView between{40, 30, 0.5, view->captured()[1].elevation_rad * 0.4, captured.distance};
    const Result<PreparedView> prepared = view->prepare(between);
    ASSERT_TRUE(prepared) << prepared.error().message;
    ASSERT_TRUE(prepared->rings.second.has_value());
    ASSERT_TRUE(prepared->rows.has_value());
    ASSERT_TRUE(view->render(between).ok());
    const Result<engine::Renderer> renderer = engine::Renderer::create(object);
    Image<Rgba8> upright(prepared->rings.nearest.width, prepared->rings.nearest.height);
    renderer->render(prepared->rings, upright);
    Image<Rgba8> expected(between.width, between.height);
    resample(upright, *prepared->rows, expected);
    EXPECT_EQ(view->image(), expected);
    Image<Rgba8> nearest(upright.width(), upright.height());
    renderer->render(prepared->rings.nearest, nearest);
    EXPECT_NE(nearest, upright);
}

// Tilted views are resampled from an upright image: close to the image of the tilted camera.
TEST(ObjectView, TiltedViewsAreResampled) {
    RaySpaceObject object = test::small_object_with_shape();
    for (PlanarImage& image : object.images) {  // smooth photos: differences are due to the geometry
        for (int y = 0; y < object.height; ++y) {
            for (int x = 0; x < object.width; ++x) image.y(x, y) = static_cast<std::uint8_t>(60 + 12 * y);
        }
        for (std::uint8_t& alpha : image.a.pixels()) alpha = 255;
        for (std::uint8_t& chroma : image.u.pixels()) chroma = 128;
        for (std::uint8_t& chroma : image.v.pixels()) chroma = 128;
    }
    Result<ObjectView> view = ObjectView::open(file_of(object), "thing", 3);
    ASSERT_TRUE(view) << view.error().message;
    constexpr int kSide = 64;
    const CapturedCamera& captured = view->captured()[0];
    constexpr double kTilt_rad = 0.2;
    ASSERT_TRUE(view->render({kSide, kSide, 0, kTilt_rad, captured.distance}).ok());
    const glm::dvec3 eye(0, std::sin(kTilt_rad) * captured.distance, std::cos(kTilt_rad) * captured.distance);
    const Camera camera =
        look_at_camera(eye * object.units_per_radius, glm::dvec3(0),
                       2 * std::atan(std::max(captured.tan_half_x, captured.tan_half_y)), kSide, kSide);
    const Result<engine::Renderer> renderer = engine::Renderer::create(object);
    Image<Rgba8> direct(kSide, kSide);
    renderer->render(engine::prepare_view(object, camera).value(), direct);
    int both = 0;
    int only_one = 0;
    int difference = 0;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const Rgba8 a = view->image()(x, y);
            const Rgba8 b = direct(x, y);
            only_one += (a.a >= 128) != (b.a >= 128) ? 1 : 0;
            if (a.a < 128 || b.a < 128) continue;
            ++both;
            difference += std::abs(a.g - b.g);
        }
    }
    EXPECT_GT(both, 300);
    EXPECT_LT(only_one, both / 10);
    EXPECT_LT(difference, 6 * both) << "of 256 levels, in the mean";
}

TEST(ObjectView, RefusesViewsOutOfRange) {
    Result<ObjectView> view = ObjectView::open(file_of(test::small_object()), "thing", 3);
    ASSERT_TRUE(view) << view.error().message;
    EXPECT_FALSE(view->render({0, 30, 0, 0, 3}).ok());
    EXPECT_FALSE(view->render({40, 30, 0, 1.6, 3}).ok());
    EXPECT_FALSE(view->render({40, 30, 0, 0, 0}).ok());
}

TEST(ObjectView, NamesTheObjectInErrors) {
    std::vector<std::byte> file = file_of(test::small_object());
    file.resize(file.size() / 2);
    const Result<ObjectView> view = ObjectView::open(file, "thing.rso", 3);
    ASSERT_FALSE(view);
    EXPECT_EQ(view.error().message.rfind("thing.rso: ", 0), 0U) << view.error().message;
}

}  // namespace
}  // namespace rs::web
