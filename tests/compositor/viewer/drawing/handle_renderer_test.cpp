// Edited lights in frames, surface picking, and handles over a frame. Skipped without OpenGL.

#include "compositor/viewer/drawing/handle_renderer.hpp"

#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "tests/compositor/gl_test.hpp"

#include <gtest/gtest.h>

namespace rs::compositor {
namespace {

constexpr int kWide_px = 160;
constexpr int kHigh_px = 120;

GeometryNode coloured_box(const glm::dvec3& size, const glm::dvec3& at, const glm::vec3& diffuse) {
    GeometryNode node;
    node.mesh = std::make_shared<const Mesh>(box_mesh(size));
    node.material.diffuse = diffuse;
    node.world_from_node[3] = glm::dvec4(at, 1);
    return node;
}

Scene lit_room() {
    Scene scene;
    scene.geometry = {coloured_box({20, 0.2, 20}, {0, -0.1, 0}, glm::vec3(0.6F)),
                      coloured_box({1, 1, 1}, {0, 0.5, 0}, {0.7F, 0.1F, 0.1F})};
    scene.floor = Floor{.height = -0.3};
    scene.lights = {point_light({1, 3, 1}, glm::vec3(3)), directional_light({-1, -2, -1}, glm::vec3(0.5F))};
    return scene;
}

Scene evening() {
    Scene scene = lit_room();
    scene.lights = {rectangle_light({-1, 3, -1}, {2, 0, 0}, {0, 0, 2}, glm::vec3(2)), scene.lights[0]};
    scene.lights[1].location = {-2, 1, 2};
    scene.lights[1].colour = {0.2F, 0.5F, 0.1F};
    scene.lights.push_back(scene.lights[1]);
    EnvironmentLight sky;
    sky.pixels = std::make_shared<const Image<RgbaF>>(4, 2, RgbaF{0.1F, 0.2F, 0.4F, 1});
    scene.environment = sky;
    scene.navigation.headlight = true;
    return scene;
}

class Handles : public test::GlTest {
protected:
    static FrameCompositor compositor_of(const Scene& scene, double exposure_ev = 0, int samples = 4) {
        auto made = FrameCompositor::create(
            scene, {}, {.width = kWide_px, .height = kHigh_px, .samples = samples, .exposure_ev = exposure_ev});
        RS_CHECK(made.ok());
        return std::move(*made);
    }
    Camera camera_ = look_at_camera({3, 2, 4}, {0, 0.4, 0}, radians(50), kWide_px, kHigh_px);
};

TEST_F(Handles, EditedLightGivesTheFramesOfASceneThatHasIt) {
    FrameCompositor edited = compositor_of(lit_room());
    const Image<Rgba8> before = edited.compose(camera_).value();
    ASSERT_TRUE(edited.set_lights(evening(), 1));
    const Image<Rgba8> after = edited.compose(camera_).value();
    FrameCompositor fresh = compositor_of(evening(), 1);
    EXPECT_EQ(after, fresh.compose(camera_).value());
    EXPECT_NE(after, before);
    ASSERT_TRUE(edited.set_lights(lit_room(), 0));
    EXPECT_EQ(edited.compose(camera_).value(), before);
}

TEST_F(Handles, TheSurfaceUnderAPixelIsWhatItShows) {
    for (const int samples : {1, 4}) {
        FrameCompositor compositor = compositor_of(lit_room(), 0, samples);
        ASSERT_TRUE(compositor.draw(camera_));
        const auto at = [&](const glm::dvec3& place) {
            const glm::dvec3 px = camera_.project(place);
            return compositor.surface_at(static_cast<int>(px.x), static_cast<int>(px.y));
        };
        // A pixel is about 3 cm wide here.
        const auto floor = at({1.2, 0, 0.8});
        ASSERT_TRUE(floor);
        EXPECT_LT(glm::distance(floor->place, glm::dvec3(1.2, 0, 0.8)), 0.08);
        EXPECT_LT(glm::distance(floor->normal, glm::dvec3(0, 1, 0)), 5e-3);  // single precision
        const auto side = at({0.5, 0.5, 0.1});
        ASSERT_TRUE(side);
        EXPECT_NEAR(side->place.x, 0.5, 0.01);
        EXPECT_LT(glm::distance(side->normal, glm::dvec3(1, 0, 0)), 1e-3);
        EXPECT_FALSE(compositor.surface_at(0, 0));
        EXPECT_FALSE(compositor.surface_at(80, -5));
    }
}

TEST_F(Handles, AreDrawnOverACopyAndFaintWhereHidden) {
    for (const int samples : {1, 4}) {
        FrameCompositor compositor = compositor_of(lit_room(), 0, samples);
        const Image<Rgba8> frame = compositor.compose(camera_).value();
        auto renderer = HandleRenderer::create();
        ASSERT_TRUE(renderer);
        auto image = gl::Framebuffer::create(kWide_px, kHigh_px, 1);
        auto depths = gl::Framebuffer::create(kWide_px, kHigh_px, samples);
        ASSERT_TRUE(image && depths);
        image->begin(glm::vec3(0.1F));
        depths->begin(glm::vec3(0));
        const glm::dvec3 before = camera_.centre() + 2.0 * camera_.ray(40, 60);
        const glm::dvec3 behind_the_camera = camera_.centre() - camera_.forward();
        const std::vector<HandleStroke> strokes = {{before, before, {1, 0, 0}, 14},
                                                   {behind_the_camera, behind_the_camera, {0, 0, 1}, 14}};
        ASSERT_TRUE(renderer->draw(strokes, camera_, *image, *depths));
        const Image<Rgba8> drawn = renderer->shown().read_image();
        EXPECT_EQ(drawn(40, 60), (Rgba8{255, 0, 0, 255}));
        EXPECT_EQ(drawn(120, 60), image->read_image()(120, 60));
        EXPECT_EQ(image->read_image()(40, 60), image->read_image()(120, 60));  // the frame itself is unchanged
        EXPECT_EQ(compositor.image(), frame);
    }
    // Handles behind the block are faint.
    FrameCompositor compositor = compositor_of(lit_room());
    ASSERT_TRUE(compositor.draw(camera_));
    const glm::dvec3 hidden(-0.3, 0.5, -0.6);
    const glm::dvec3 px = camera_.project(hidden);
    const Rgba8 block = compositor.image()(static_cast<int>(px.x), static_cast<int>(px.y));
    ASSERT_TRUE(compositor.draw_handles({{hidden, hidden, {0, 1, 0}, 14}}));
    const Rgba8 faint = compositor.handles()->shown().read_image()(static_cast<int>(px.x), static_cast<int>(px.y));
    EXPECT_GT(faint.g, block.g + 20);
    EXPECT_LT(faint.g, 230);
}

}  // namespace
}  // namespace rs::compositor
