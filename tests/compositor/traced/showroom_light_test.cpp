// The showroom, whose lights illuminate one room each, by all renderers. Skipped without OpenGL.

#include "compositor/scene/reader/scene_file.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "datasets-synthetic/showroom/showroom.hpp"
#include "datasets-synthetic/showroom/world_file.hpp"
#include "rayspace/image/linear_light.hpp"
#include "tests/compositor/gl_test.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace rs::compositor {
namespace {

constexpr int kRoomWidth_px = 64;
constexpr int kRoomHeight_px = 36;

double mean_luminance(const Image<Rgba8>& image) {
    double sum = 0;
    for (const Rgba8& p : image.pixels()) {
        sum += 0.2126 * static_cast<double>(linear_from_srgb8(p.r)) +
               0.7152 * static_cast<double>(linear_from_srgb8(p.g)) +
               0.0722 * static_cast<double>(linear_from_srgb8(p.b));
    }
    return sum / static_cast<double>(image.pixels().size());
}

class ShowroomLight : public test::GlTest {};

TEST_F(ShowroomLight, IsAboutAsBrightTracedAsRasterized) {
    const test::TemporaryFolder folder;
    ASSERT_TRUE(
        synthetic::write_world(synthetic::make_showroom({.texture_scale = 0.05F}), folder / "room", "room", ".."));
    Result<Scene> scene = read_scene(folder / "room" / "room.wrl");
    ASSERT_TRUE(scene) << scene.error().message;
    scene->objects.clear();
    ASSERT_GE(scene->viewpoints.size(), 8U);
    auto raster = FrameCompositor::create(*scene, {}, {.width = kRoomWidth_px, .height = kRoomHeight_px});
    ASSERT_TRUE(raster) << raster.error().message;
    for (const Viewpoint& viewpoint : scene->viewpoints) {
        SCOPED_TRACE(viewpoint.description);
        Camera camera =
            look_at_camera({0, 0, 0}, {0, 0, -1}, viewpoint.field_of_view_rad, kRoomWidth_px, kRoomHeight_px);
        camera.world_from_camera = viewpoint.world_from_camera;
        const double rasterized = mean_luminance(raster->compose(camera).value());
        for (const auto& [method, passes] : {std::pair(TracedMethod::kWhitted, 1), {TracedMethod::kRadiosity, 4}}) {
            auto traced = TracedRenderer::create(*scene, {}, {.method = method});
            ASSERT_TRUE(traced) << traced.error().message;
            traced->begin_image(camera);
            for (int pass = 0; pass < passes; ++pass) ASSERT_TRUE(traced->add_pass());
            raster->set_traced(std::make_shared<const Image<Rgba8>>(traced->image()));
            const double ratio = mean_luminance(raster->compose(camera).value()) / rasterized;
            EXPECT_GT(ratio, method == TracedMethod::kWhitted ? 0.85 : 0.5);
            EXPECT_LT(ratio, method == TracedMethod::kWhitted ? 1.1 : 1.5);
            raster->set_traced(nullptr);
        }
    }
}

}  // namespace
}  // namespace rs::compositor
