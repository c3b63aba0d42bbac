// Lit floors against the lighting formula. Skipped without OpenGL.

#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "rayspace/image/linear_light.hpp"
#include "tests/compositor/gl_test.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

namespace rs::compositor {
namespace {

constexpr int kFloorImage_px = 33;  // odd, so that the central pixel is centred
constexpr float kAlbedo = 0.5F;

class LitFloor : public test::GlTest {
protected:
    LitFloor() {
        scene_.floor = Floor{.height = -0.5, .colour_a = glm::vec3(kAlbedo), .colour_b = glm::vec3(kAlbedo)};
        scene_.background.sky = {glm::vec3(0)};
    }

    // Linear light at a place on the floor.
    [[nodiscard]] float seen_at(double x, double z) const {
        auto compositor = FrameCompositor::create(scene_, {}, {.width = kFloorImage_px, .height = kFloorImage_px});
        RS_CHECK(compositor.ok());
        const glm::dvec3 at(x, -0.5, z);
        const Camera camera = look_at_camera(at + glm::dvec3(0, 2, 1), at, radians(20), kFloorImage_px, kFloorImage_px);
        const Image<Rgba8> image = compositor->compose(camera).value();
        return linear_from_srgb8(image(kFloorImage_px / 2, kFloorImage_px / 2).g);
    }

    static float reflected(const Light& light, const glm::dvec3& at) {
        const glm::dvec3 way = light.location - at;
        return kAlbedo * irradiance_at(light, at).g * static_cast<float>(way.y / glm::length(way) / kPi);
    }

    Scene scene_;
};

TEST_F(LitFloor, PointLightsFallOff) {
    const Light light = point_light({0.5, 0.5, 0}, glm::vec3(2));
    scene_.lights = {light};
    for (const double x : {0.5, 1.5, -1.0}) {
        EXPECT_NEAR(seen_at(x, 0.3), reflected(light, {x, -0.5, 0.3}), 0.01F) << x;
    }
    EXPECT_GT(seen_at(0.5, 0), 5 * seen_at(3, 0));
    scene_.lights[0].location.y = -1.5;  // below
    EXPECT_EQ(seen_at(0.5, 0), 0);
}

TEST_F(LitFloor, SpotsLightTheirCone) {
    Light spot = point_light({0, 1.5, 0}, glm::vec3(3));
    spot.kind = LightKind::kSpot;
    spot.towards = {0, -1, 0};
    spot.beam_width_rad = spot.cut_off_rad = 0.3;
    scene_.lights = {spot, directional_light({0, -1, 0}, glm::vec3(0.2F))};
    const float sun = kAlbedo * 0.2F / static_cast<float>(kPi);
    EXPECT_NEAR(seen_at(0.3, 0), reflected(spot, {0.3, -0.5, 0}) + sun, 0.01F);
    EXPECT_NEAR(seen_at(1.2, 0), sun, 0.003F);
}

TEST_F(LitFloor, AnEnvironmentLightsItFromAbove) {
    scene_.lights.clear();
    auto sky = std::make_shared<Image<RgbaF>>(8, 4, RgbaF{0, 0, 0, 1});
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 8; ++x) (*sky)(x, y) = {0.8F, 0.8F, 0.8F, 1};
    }
    scene_.environment = EnvironmentLight{sky, 1, 0, false};
    EXPECT_NEAR(seen_at(0, 0), kAlbedo * 0.8F, 0.01F);
}

TEST_F(LitFloor, ManyLightsAreLimited) {
    scene_.lights.assign(300, point_light({0, 1.5, 0}, glm::vec3(0.02F)));
    EXPECT_NEAR(seen_at(0, 0), 48 * reflected(scene_.lights[0], {0, -0.5, 0}), 0.01F);
}

}  // namespace
}  // namespace rs::compositor
