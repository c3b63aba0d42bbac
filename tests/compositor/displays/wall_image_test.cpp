// Rendered walls and quilts. Skipped without OpenGL.

#include "compositor/displays/quilt.hpp"
#include "compositor/displays/walls_file.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "rayspace/base/conventions.hpp"
#include "tests/compositor/gl_test.hpp"
#include "tests/compositor/objects.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rs::compositor {
namespace {

constexpr int kWallSide_px = 128;

double psnr(const Image<Rgba8>& a, const Image<Rgba8>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        const Rgba8 p = a.pixels()[i], q = b.pixels()[i];
        for (const int d : {p.r - q.r, p.g - q.g, p.b - q.b}) sum += d * d;
    }
    if (sum == 0) return INFINITY;
    return 10 * std::log10(255.0 * 255.0 * 3 * static_cast<double>(a.pixels().size()) / sum);
}

Image<Rgba8> cropped(const Image<Rgba8>& image, int x, int y, int width, int height) {
    Image<Rgba8> part(width, height);
    const auto from = image.view().crop(x, y, width, height);
    for (int row = 0; row < height; ++row) std::copy_n(from.row(row), width, part.row(row));
    return part;
}

// Boxes in a room with a floor.
Scene boxes(int count = 12) {
    Scene scene;
    scene.floor = Floor{};
    scene.background.sky = {{0.1F, 0.2F, 0.5F}, {0.6F, 0.6F, 0.7F}};
    scene.background.sky_angles_rad = {1.5};
    for (int i = 0; i < count; ++i) {
        GeometryNode box;
        box.mesh = std::make_shared<const Mesh>(box_mesh({0.5, 0.3 + 0.2 * i, 0.4}));
        box.material.diffuse = {0.1F + 0.07F * static_cast<float>(i), 0.5F, 0.8F - 0.06F * static_cast<float>(i)};
        NodeTransform at;
        at.translation = {-3 + 0.61 * i, 0.4, -4 - 0.3 * (i % 3)};
        at.angle_rad = 0.3 * i;
        box.world_from_node = at.parent_from_node().matrix();
        scene.geometry.push_back(box);
    }
    return scene;
}

// Wall with an integer principal point, and the camera that looks straight ahead with a larger image that contains the
// wall's.
struct WallAndCrop {
    Camera wall;
    Camera oversized;
    int x = 0;
    int y = 0;
};
WallAndCrop wall_and_crop() {
    const Wall wall{"front", {-1.5, 0, -1.5}, {1.5, 0, -1.5}, {-1.5, 3, -1.5}, kWallSide_px, kWallSide_px};
    // 3 m are 128 pixels: 24 pixels left of the centre, 8 above it.
    const glm::dvec3 eye(-24 * 3.0 / kWallSide_px, 1.5 + 8 * 3.0 / kWallSide_px, 0.2);
    WallAndCrop made;
    made.wall = *wall_camera(wall, eye, {.heading_rad = 0.2});
    made.oversized = made.wall;
    made.oversized.width = made.oversized.height = 2 * kWallSide_px;
    made.oversized.cx = made.oversized.cy = kWallSide_px;
    made.x = kWallSide_px - (kWallSide_px / 2 - 24);
    made.y = kWallSide_px - (kWallSide_px / 2 - 8);
    EXPECT_NEAR(made.wall.cx, kWallSide_px / 2 - 24, 1e-9);
    EXPECT_NEAR(made.wall.cy, kWallSide_px / 2 - 8, 1e-9);
    return made;
}

class WallImage : public test::GlTest {
protected:
    static Image<Rgba8> compose(const Scene& scene, const std::vector<PlacedObject>& objects, const Camera& camera,
                                int samples) {
        auto compositor = FrameCompositor::create(scene, objects,
                                                  {.width = camera.width, .height = camera.height, .samples = samples});
        RS_CHECK(compositor.ok());
        auto frame = compositor->compose(camera);
        RS_CHECK(frame.ok());
        return std::move(*frame);
    }
    static Image<Rgba8> crop_of_oversized(const Scene& scene, const std::vector<PlacedObject>& objects, int samples) {
        const WallAndCrop cameras = wall_and_crop();
        return cropped(compose(scene, objects, cameras.oversized, samples), cameras.x, cameras.y, kWallSide_px,
                       kWallSide_px);
    }
};

TEST_F(WallImage, IsTheCropOfAnOversizedOneBitForBit) {
    Scene scene = boxes();
    scene.floor.reset();
    const std::vector<PlacedObject> objects{test::placed_at(test::drum(), {.translation = {0.3, 1.2, -3.2}}),
                                            test::placed_at(test::drum(), {.translation = {-1.4, 1.9, -6}})};
    const Image<Rgba8> wall = compose(scene, objects, wall_and_crop().wall, 1);
    const Image<Rgba8> crop = crop_of_oversized(scene, objects, 1);
    EXPECT_EQ(wall, crop);
    EXPECT_GE(psnr(compose(scene, objects, wall_and_crop().wall, 4), crop_of_oversized(scene, objects, 4)), 50);
}

// The floor's checker fades with the distance, a float interpolated over the image, which may be rounded to the next of
// 255 steps.
TEST_F(WallImage, IsTheCropOfAnOversizedOneWithAFloor) {
    const Image<Rgba8> wall = compose(boxes(), {}, wall_and_crop().wall, 1);
    const Image<Rgba8> crop = crop_of_oversized(boxes(), {}, 1);
    int different = 0;
    for (std::size_t i = 0; i < wall.pixels().size(); ++i) different += wall.pixels()[i] != crop.pixels()[i];
    EXPECT_LE(different, 16);
    EXPECT_GE(psnr(wall, crop), 80);
}

TEST_F(WallImage, IsTracedAsTheCropOfAnOversizedOne) {
    const WallAndCrop cameras = wall_and_crop();
    auto tracer = TracedRenderer::create(boxes(), {}, {.method = TracedMethod::kWhitted});
    ASSERT_TRUE(tracer.ok()) << tracer.error().message;
    // Over black: the colour of a pixel that only one of many rays hits is undefined.
    const auto traced = [&](const Camera& camera) {
        tracer->begin_image(camera);
        for (int pass = 0; pass < 64; ++pass) tracer->add_pass();
        Image<Rgba8> image = tracer->image();
        for (Rgba8& pixel : image.pixels()) pixel = over(pixel, {0, 0, 0, 255});
        return image;
    };
    const Image<Rgba8> wall = traced(cameras.wall);
    const Image<Rgba8> crop = cropped(traced(cameras.oversized), cameras.x, cameras.y, kWallSide_px, kWallSide_px);
    EXPECT_GE(psnr(wall, crop), 50);
    EXPECT_LT(psnr(wall, Image<Rgba8>(kWallSide_px, kWallSide_px, {0, 0, 0, 255})), 40);
}

// A small bright square and its image position for each eye.
TEST_F(WallImage, ShowsAPointToEachEyeWhereTheFormulaSays) {
    Scene scene;
    scene.background.sky = {glm::vec3(0)};
    GeometryNode square;
    square.mesh = std::make_shared<const Mesh>(box_mesh({0.4, 0.4, 1e-4}));
    square.material.lit = false;
    square.material.diffuse = glm::vec3(1);
    square.world_from_node[3] = glm::dvec4(0.1, 1.4, -6, 1);
    scene.geometry.push_back(square);
    const Wall wall{"front", {-1.5, 0, -1.5}, {1.5, 0, -1.5}, {-1.5, 3, -1.5}, 1024, 1024};
    const Head head{.position = {0.2, 1.6, 0.3}};
    const auto middle = [&](double offset) {
        const Camera camera = *wall_camera(wall, head.eye(offset), {});
        const Image<Rgba8> image = compose(scene, {}, camera, 1);
        double sum = 0, weight = 0;
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                sum += image(x, y).r * (x + 0.5);
                weight += image(x, y).r;
            }
        }
        EXPECT_NEAR(sum / weight, camera.project({0.1, 1.4, -6}).x, 0.5);
        return sum / weight;
    };
    // 0.065 m (1 - 1.8/6.3) of 1024 pixels on 3 m; edges fall on whole pixels.
    EXPECT_NEAR(middle(0.0325) - middle(-0.0325), 0.065 * (1 - 1.8 / 6.3) * 1024 / 3, 1);
}

TEST_F(WallImage, TilesOfAQuiltAreTheViewsAlone) {
    const std::vector<PlacedObject> objects{test::placed_at(test::drum(), {.translation = {0, 1, 0}})};
    Scene scene;
    scene.floor = Floor{};
    const QuiltLayout layout{3, 2, 60, 80};
    const std::vector<Camera> cameras =
        quilt_cameras(look_at_camera({0, 1.3, 5}, {0, 1, 0}, radians(40), 60, 80), layout, radians(35), 5);
    auto compositor = FrameCompositor::create(scene, objects, {.width = 60, .height = 80});
    ASSERT_TRUE(compositor.ok());
    Image<Rgba8> quilt(layout.width(), layout.height());
    for (int view = 0; view < layout.views(); ++view) {
        const auto tile = compositor->compose(cameras[static_cast<std::size_t>(view)]);
        ASSERT_TRUE(tile.ok());
        place_tile(layout, view, *tile, quilt);
    }
    for (int view = 0; view < layout.views(); ++view) {
        const Image<Rgba8> alone = compose(scene, objects, cameras[static_cast<std::size_t>(view)], 4);
        EXPECT_EQ(alone, cropped(quilt, view % 3 * 60, (1 - view / 3) * 80, 60, 80)) << view;
    }
}

}  // namespace
}  // namespace rs::compositor
