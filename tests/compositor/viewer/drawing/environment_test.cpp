// Environments in raster images against the traced look-up and the projection. Skipped without OpenGL.

#include "capture/tracer/light/environment_map.hpp"
#include "compositor/scene/light/environment_irradiance.hpp"
#include "rayspace/image/linear_light.hpp"
#include "tests/compositor/viewer/drawing/compositing.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

namespace rs::compositor {
namespace {

// Values from 0.3 to 1 that differ between neighbours.
EnvironmentLight coloured_sky() {
    Image<RgbaF> pixels(16, 8);
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 16; ++x) {
            const glm::ivec3 steps(x / 2, 7 - y, (3 * x + 5 * y) % 8);
            const glm::vec3 p = 0.3F + 0.1F * glm::vec3(steps);
            pixels(x, y) = {p.r, p.g, p.b, 1};
        }
    }
    return {std::make_shared<const Image<RgbaF>>(std::move(pixels)), 0.4F, 0.7F, true};
}

Rgba8 srgb_of(const glm::vec3& light) {
    return {srgb8_from_linear(light.r), srgb8_from_linear(light.g), srgb8_from_linear(light.b), 255};
}

class RasterEnvironment : public Compositing {
protected:
    static Image<Rgba8> image_of(const Scene& scene, const Camera& camera, double exposure_ev = 0) {
        auto compositor = FrameCompositor::create(
            scene, {}, {.width = camera.width, .height = camera.height, .samples = 1, .exposure_ev = exposure_ev});
        RS_CHECK(compositor.ok());
        return compositor->compose(camera).value();
    }
};

TEST_F(RasterEnvironment, SeenItIsTheBackgroundOfTracedImages) {
    Scene scene;
    scene.environment = coloured_sky();
    const capture::EnvironmentMap traced({*scene.environment->pixels, 2 * 0.4F, 0.7F});
    for (const glm::dvec3& at : {glm::dvec3(0, 0.2, -1), glm::dvec3(1, -0.8, 0.3), glm::dvec3(-0.2, 0.9, 1)}) {
        const Camera camera = look_at_camera({0, 0, 0}, at, radians(70), kFrameWidth, kFrameHeight);
        const Image<Rgba8> image = image_of(scene, camera, 1);
        for (int y = 0; y < kFrameHeight; y += 7) {
            for (int x = 0; x < kFrameWidth; x += 7) {
                const glm::vec3 ray(glm::normalize(camera.ray(x + 0.5, y + 0.5)));
                EXPECT_LE(difference(image(x, y), srgb_of(traced.radiance(ray))), 3) << x << " " << y;
            }
        }
    }
}

TEST_F(RasterEnvironment, UnseenItLeavesTheBackground) {
    Scene scene;
    scene.background.sky = {{0.2F, 0.5F, 0.9F}};
    EXPECT_EQ(middle(image_of(scene, kFront)), srgb_of({0.2F, 0.5F, 0.9F}));
    scene.environment = coloured_sky();
    scene.environment->seen = false;
    EXPECT_EQ(middle(image_of(scene, kFront)), srgb_of({0.2F, 0.5F, 0.9F}));
}

TEST_F(RasterEnvironment, LightsSurfacesByTheirNormals) {
    for (const Shading shading : {Shading::kVrml, Shading::kPhong}) {
        Scene scene = with_box({1, 1, 1}, {0, 0, 0});
        scene.shading = shading;
        scene.geometry[0].material.diffuse = glm::vec3(0.6F, 0.5F, 0.7F);
        scene.geometry[0].material.phong = PhongTerms{.ambient = glm::vec3(0.3F)};
        scene.lights.clear();
        scene.environment = coloured_sky();
        scene.environment->scale = 1;
        const IrradianceHarmonics harmonics = project_irradiance(*scene.environment);
        for (const glm::vec3& n : {glm::vec3(0, 0, 1), glm::vec3(1, 0, 0), glm::vec3(0, 0, -1), glm::vec3(-1, 0, 0)}) {
            const Camera camera =
                look_at_camera(3.0 * glm::dvec3(n), {0, 0, 0}, radians(30), kFrameWidth, kFrameHeight);
            const glm::vec3 reflectance =
                shading == Shading::kPhong ? glm::vec3(0.3F) : scene.geometry[0].material.diffuse;
            const Rgba8 expected = srgb_of(reflectance * harmonics.at(n));
            EXPECT_LE(difference(middle(image_of(scene, camera)), expected), 1);
        }
        EXPECT_GT(glm::distance(harmonics.at({1, 0, 0}), harmonics.at({-1, 0, 0})), 0.1F);
    }
}

TEST_F(RasterEnvironment, EditedItGivesTheFramesOfASceneThatHasIt) {
    Scene scene = with_box({1, 1, 1}, {0, -0.5, 0});
    scene.floor = Floor{.height = -1};
    auto edited = FrameCompositor::create(scene, {}, {.width = kFrameWidth, .height = kFrameHeight});
    ASSERT_TRUE(edited);
    const Image<Rgba8> before = edited->compose(kFront).value();
    Scene changed = scene;
    changed.environment = coloured_sky();
    for (const float turn_rad : {0.7F, 2.0F}) {
        changed.environment->turn_rad = turn_rad;
        ASSERT_TRUE(edited->set_lights(changed, 0.5));
        const Image<Rgba8> after = edited->compose(kFront).value();
        auto fresh =
            FrameCompositor::create(changed, {}, {.width = kFrameWidth, .height = kFrameHeight, .exposure_ev = 0.5});
        ASSERT_TRUE(fresh);
        EXPECT_EQ(after, fresh->compose(kFront).value());
        EXPECT_NE(after, before);
    }
    ASSERT_TRUE(edited->set_lights(scene, 0));
    EXPECT_EQ(edited->compose(kFront).value(), before);
}

}  // namespace
}  // namespace rs::compositor
