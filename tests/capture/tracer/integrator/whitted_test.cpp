// Whitted ray tracing against analytic formulas.

#include "capture/tracer/light/environment_map.hpp"
#include "rayspace/light/directions.hpp"
#include "tests/capture/tracer/test_shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rs::capture::test {
namespace {

RenderOptions whitted() {
    RenderOptions options;
    options.method = RenderMethod::kWhitted;
    options.samples_per_pixel = 1;
    options.filter_radius_px = 0.01F;
    return options;
}

// A camera above the origin with a small patch of the floor in view.
Camera small_patch_camera() {
    return look_at_camera({0, 1, 0.5}, {0, 0, 0}, radians(0.1), 4, 4);
}

double brightness(Scene scene, const Camera& camera, const RenderOptions& options = whitted()) {
    return mean_radiance(render(std::move(scene), camera, options).image).g;
}

TEST(Whitted, DirectLightIsThatOfTheFormulaWithoutNoise) {
    Scene scene = scene_of(floor_quad(), material_of(SurfaceKind::diffuse, glm::vec3(0.5F)));
    scene.lights = {point_light({0, 2, 1}, glm::vec3(3.0F)), directional_light({1, -1, 0}, glm::vec3(2.0F))};
    const double of_point = 3 / 5.0 * 2 / std::sqrt(5.0), of_sun = 2 * std::sqrt(0.5);
    EXPECT_NEAR(brightness(scene, small_patch_camera()), 0.5 / kPi * (of_point + of_sun), 1e-3);
    RenderOptions with_ambient = whitted();
    with_ambient.ambient = glm::vec3(0.25F);
    EXPECT_NEAR(brightness(scene, small_patch_camera(), with_ambient), 0.5 / kPi * (of_point + of_sun) + 0.125, 1e-3);
}

TEST(Whitted, ShadowsAreHard) {
    Scene scene = scene_of(floor_quad(), material_of(SurfaceKind::diffuse));
    scene.lights = {rectangle_light({-0.5F, 4, -0.5F}, {1, 0, 0}, {0, 0, 1}, glm::vec3(2.0F))};
    scene.meshes.push_back(make_quad({0, 2, -9}, {9, 0, 0}, {0, 0, 18}));  // its edge at half the height of the light
    const Camera camera = look_at_camera({0, 1.5, 0.01}, {0, 0, 0}, radians(60), 64, 3);
    const Image<RgbaF> image = render(std::move(scene), camera, whitted()).image;
    for (int x = 0; x < 64; ++x) {
        if (x < 31) {
            EXPECT_GT(image(x, 1).g, 0.03) << x;
        } else if (x > 32) {
            EXPECT_EQ(image(x, 1).g, 0) << x;
        }
    }
}

TEST(Whitted, AreasAndSurfacesThatShineCountAsTheirMiddle) {
    // At 3 m the centre point approximates the form factor.
    const auto expected = 0.8 * 2 * 1 / (kPi * 9);
    Scene by_area = scene_of(floor_quad(), material_of(SurfaceKind::diffuse, glm::vec3(0.8F)));
    by_area.lights = {rectangle_light({-0.5F, 3, -0.5F}, {1, 0, 0}, {0, 0, 1}, glm::vec3(2.0F))};
    EXPECT_NEAR(brightness(by_area, small_patch_camera()), expected, 1e-3);
    Scene by_mesh = scene_of(floor_quad(), material_of(SurfaceKind::diffuse, glm::vec3(0.8F)));
    Material lamp = material_of(SurfaceKind::diffuse, glm::vec3(0.0F));
    lamp.emission = glm::vec3(2.0F);
    by_mesh.materials.push_back(lamp);
    by_mesh.meshes.push_back(make_quad({-0.5F, 3, -0.5F}, {1, 0, 0}, {0, 0, 1}));
    by_mesh.meshes.back().material = 1;
    EXPECT_NEAR(brightness(by_mesh, small_patch_camera()), expected, 1e-3);
    // A ball of radius 0.5 appears as a disc of the same radius from all sides.
    by_mesh.meshes.back() = make_sphere(4);
    by_mesh.meshes.back().material = 1;
    for (glm::vec3& p : by_mesh.meshes.back().positions) p = 0.5F * p + glm::vec3(0, 3, 0);
    EXPECT_NEAR(brightness(by_mesh, small_patch_camera()), 0.8 * 2 * 0.25 / 9, 2e-3);
}

TEST(Whitted, MirrorsAndGlassAreFollowed) {
    const auto seen_by = [](SurfaceKind kind, const glm::vec3& colour, int depth) {
        Scene scene = scene_of(floor_quad(), material_of(kind, colour));
        scene.meshes[0] = make_quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0});
        scene.environment = constant_environment(2.0F);
        RenderOptions options = whitted();
        options.max_bounces = depth;
        return brightness(std::move(scene), look_at_camera({0, 0, 2}, {0, 0, 0}, radians(0.1), 4, 4), options);
    };
    EXPECT_NEAR(seen_by(SurfaceKind::mirror, glm::vec3(0.9F), 8), 1.8, 1e-3);
    EXPECT_NEAR(seen_by(SurfaceKind::metal, glm::vec3(0.7F), 8), 1.4, 1e-3);
    EXPECT_EQ(seen_by(SurfaceKind::mirror, glm::vec3(0.9F), 0), 0);
    EXPECT_NEAR(seen_by(SurfaceKind::glass, glm::vec3(1.0F), 8), 2, 1e-3);  // reflected plus transmitted
}

TEST(Whitted, TwoMirrorsEndAfterEightReflections) {
    Scene scene;
    scene.materials = {material_of(SurfaceKind::mirror, glm::vec3(1.0F)),
                       material_of(SurfaceKind::diffuse, glm::vec3(0.0F))};
    scene.meshes = {make_quad({-9, -9, -1}, {18, 0, 0}, {0, 18, 0}), make_quad({-9, -9, 1}, {0, 18, 0}, {18, 0, 0})};
    scene.environment = constant_environment(1.0F);
    const Camera camera = look_at_camera({0, 0, 0}, {0, 0, -1}, radians(0.1), 2, 2);
    EXPECT_EQ(brightness(std::move(scene), camera), 0);
}

TEST(Whitted, AnEvenEnvironmentLightsEverySideAlike) {
    Scene scene = scene_of(make_sphere(5), material_of(SurfaceKind::diffuse, glm::vec3(0.6F)));
    scene.environment = constant_environment(1.5F);
    const Image<RgbaF> image = render(std::move(scene), front_camera(3.5, 36, 32), whitted()).image;
    int seen = 0;
    for (const RgbaF& p : image.pixels()) {
        if (p.a < 1) continue;
        EXPECT_NEAR(p.g, 0.9, 0.005 * 0.9);
        ++seen;
    }
    EXPECT_GT(seen, 300);
}

TEST(IrradianceMap, IsTheIntegralOfCosineAndRadiance) {
    // L = 1 + a . d gives pi (1 + 2/3 a . n).
    const glm::vec3 a(0.3F, 0.6F, -0.4F);
    Environment sky;
    sky.pixels = Image<RgbaF>(256, 128);
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 256; ++x) {
            const double polar = kPi * (y + 0.5) / 128, turn = 2 * kPi * ((x + 0.5) / 256 - 0.5);
            const glm::vec3 d(std::sin(polar) * std::sin(turn), std::cos(polar), -std::sin(polar) * std::cos(turn));
            const float radiance = 1 + glm::dot(a, d);
            sky.pixels(x, y) = {radiance, 2 * radiance, 0, 1};
        }
    }
    const IrradianceMap map{EnvironmentMap(sky)};
    for (int i = 0; i < 200; ++i) {
        const double height = 1 - (i + 0.5) / 100, turn = 2.4 * i, across = std::sqrt(1 - height * height);
        const glm::vec3 n(across * std::cos(turn), height, across * std::sin(turn));
        const float expected = kPiF * (1 + 2.0F / 3 * glm::dot(a, n));
        const glm::vec3 found = map.at(n);
        EXPECT_NEAR(found.r, expected, 0.01 * expected) << i;
        EXPECT_NEAR(found.g, 2 * expected, 0.02 * expected) << i;
        EXPECT_EQ(found.b, 0);
    }
}

}  // namespace
}  // namespace rs::capture::test
