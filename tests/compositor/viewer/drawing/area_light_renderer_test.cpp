// Visible area lights. Skipped without OpenGL.

#include "rayspace/image/linear_light.hpp"
#include "tests/compositor/viewer/drawing/compositing.hpp"

#include <gtest/gtest.h>

namespace rs::compositor {
namespace {

class VisibleAreas : public Compositing {
protected:
    // A light of 2 x 2 units that shines along +Z, towards kFront.
    static Scene lit_by(LightKind kind) {
        Scene scene;
        scene.background.sky = {glm::vec3(0)};
        Light light = rectangle_light({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, {0.5F, 0.25F, 3});
        light.kind = kind;
        scene.lights = {light};
        return scene;
    }

    static bool shows(Rgba8 pixel, const glm::vec3& light) {
        return is_colour(pixel,
                         {srgb8_from_linear(light.r), srgb8_from_linear(light.g), srgb8_from_linear(light.b), 255});
    }
};

TEST_F(VisibleAreas, AreSeenFromTheSideTheyShineTo) {
    for (const LightKind kind : {LightKind::kRectangle, LightKind::kDisc}) {
        const Image<Rgba8> front = compose(lit_by(kind), {});
        EXPECT_TRUE(shows(middle(front), {0.5F, 0.25F, 1}));
        // (0.85, 0.85) on the light, which is a corner of the rectangle and outside of the disc.
        const double scale_px = kFront.fl_x / 5;
        const Rgba8 corner = front(static_cast<int>(kFrameWidth / 2 + 0.85 * scale_px),
                                   static_cast<int>(kFrameHeight / 2 - 0.85 * scale_px));
        EXPECT_TRUE(shows(corner, kind == LightKind::kDisc ? glm::vec3(0) : glm::vec3(0.5F, 0.25F, 1)));
        const Camera behind = look_at_camera({0, 0, -5}, {0, 0, 0}, radians(50), kFrameWidth, kFrameHeight);
        EXPECT_TRUE(shows(middle(compose(lit_by(kind), {}, behind)), glm::vec3(0)));
    }
}

TEST_F(VisibleAreas, AreHiddenByGeometryAndFog) {
    Scene scene = lit_by(LightKind::kRectangle);
    scene.geometry = with_box({0.5, 0.5, 0.5}, {0, 0, 1}).geometry;
    scene.geometry[0].material.lit = false;
    EXPECT_TRUE(shows(middle(compose(scene, {})), {0.1F, 0.6F, 0.1F}));
    scene.geometry.clear();
    scene.fog = Fog{FogKind::kLinear, {0.2F, 0.2F, 0.2F}, 10};
    EXPECT_TRUE(shows(middle(compose(scene, {})), {0.35F, 0.225F, 0.6F}));
}

TEST_F(VisibleAreas, AreScaledByTheExposure) {
    const Scene scene = lit_by(LightKind::kRectangle);
    auto compositor =
        FrameCompositor::create(scene, {}, {.width = kFrameWidth, .height = kFrameHeight, .exposure_ev = -1});
    ASSERT_TRUE(compositor);
    EXPECT_TRUE(shows(middle(compositor->compose(kFront).value()), {0.25F, 0.125F, 1}));
    ASSERT_TRUE(compositor->set_lights(scene, -2));
    EXPECT_TRUE(shows(middle(compositor->compose(kFront).value()), {0.125F, 0.0625F, 0.75F}));
}

}  // namespace
}  // namespace rs::compositor
