// Light sources against radiometric formulas.

#include "capture/tracer/integrator/sampler.hpp"
#include "capture/tracer/light/environment_map.hpp"
#include "tests/capture/tracer/test_shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rs::capture::test {
namespace {

constexpr float kPiF = 3.14159265F;

RenderOptions direct_light(int samples) {
    RenderOptions options;
    options.samples_per_pixel = samples;
    return options;
}

// A camera above the origin with a patch of the plane y = 0 of about 0.02 a side in view.
Camera patch_camera() {
    return look_at_camera({0, 1, 0.5}, {0, 0, 0}, radians(1.0), 8, 8);
}

TEST(DirectionalLight, LambertSphereFollowsItsFormula) {
    Scene scene = scene_of(make_sphere(5), material_of(SurfaceKind::diffuse, glm::vec3(0.6F)));
    const glm::vec3 to_light = glm::normalize(glm::vec3(1, 2, 2));
    scene.lights.push_back(directional_light(-to_light, glm::vec3(3.0F)));
    const Camera camera = front_camera(3.5, 36.0, 64);
    const Rendering rendering = render(std::move(scene), camera, direct_light(16));
    int compared = 0;
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            if (rendering.image(x, y).a < 1.0F) continue;
            const glm::dvec3 d = glm::normalize(camera.ray(x + 0.5, y + 0.5));
            const double b = glm::dot(camera.centre(), d);
            const double discriminant = b * b - glm::dot(camera.centre(), camera.centre()) + 1.0;
            if (discriminant < 0.01) continue;  // at the limb a pixel spans too many normals
            const glm::vec3 normal(camera.centre() + d * (-b - std::sqrt(discriminant)));
            const float expected = 0.6F / kPiF * 3.0F * std::max(0.0F, glm::dot(normal, to_light));
            EXPECT_NEAR(rendering.image(x, y).g, expected, 0.012F) << x << ", " << y;
            ++compared;
        }
    }
    EXPECT_GT(compared, 1000);
}

TEST(DirectionalLight, CoarseSphereShowsNoFacetsAtTheTerminator) {
    // 320 triangles with smooth normals: the lit part must follow the smooth normal, not end at facet edges.
    Scene scene = scene_of(make_sphere(2), material_of(SurfaceKind::diffuse));
    scene.lights.push_back(directional_light({-1, 0, 0}, glm::vec3(kPiF)));
    const Camera camera = front_camera(8.0, 15.0, 64);
    const Rendering rendering = render(std::move(scene), camera, direct_light(16));
    for (int x = 36; x < 56; ++x) {
        const double along = (x + 0.5 - 32.0) / camera.fl_x * 7.0;  // approximate position of the hit
        EXPECT_NEAR(rendering.image(x, 32).g, along, 0.06) << x;
    }
}

TEST(PointLight, FallsOffWithTheSquareOfDistance) {
    double at_one = 0;
    for (const float distance : {1.0F, 2.0F, 5.0F}) {
        Scene scene = scene_of(floor_quad(), material_of(SurfaceKind::diffuse, glm::vec3(0.5F)));
        scene.lights.push_back(point_light({0, distance, 0}, glm::vec3(2.0F)));
        const double mean = mean_radiance(render(std::move(scene), patch_camera(), direct_light(4)).image).g;
        EXPECT_NEAR(mean, 0.5 / kPi * 2.0 / (distance * distance), 2e-3 * mean);
        if (distance == 1.0F) at_one = mean;
        EXPECT_NEAR(mean * distance * distance, at_one, 2e-3 * at_one);
    }
}

TEST(RectangleLight, GivesTheAnalyticFormFactor) {
    // A 2 a by 2 b rectangle at height 1, centred above the point (Howell's catalogue, B-4, four quarters).
    const double a = 1.5;
    const double b = 0.5;
    const double ra = std::sqrt(1 + a * a);
    const double rb = std::sqrt(1 + b * b);
    const double form_factor = 2 / kPi * (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb));
    Scene scene = scene_of(floor_quad(), material_of(SurfaceKind::diffuse, glm::vec3(0.7F)));
    // cross(u, v) points down.
    scene.lights.push_back(rectangle_light({-1.5F, 1, -0.5F}, {3, 0, 0}, {0, 0, 1}, glm::vec3(4.0F)));
    ASSERT_LT(glm::cross(glm::vec3(3, 0, 0), glm::vec3(0, 0, 1)).y, 0.0F);
    const double mean = mean_radiance(render(std::move(scene), patch_camera(), direct_light(1024)).image).g;
    EXPECT_NEAR(mean, 0.7 * 4.0 * form_factor, 0.005 * mean);
}

TEST(RectangleLight, IsDarkFromBehindAndSeenInMirrorsOnly) {
    Scene scene = scene_of(floor_quad(), material_of(SurfaceKind::mirror, glm::vec3(0.9F)));
    scene.lights.push_back(rectangle_light({-5, 3, -5}, {10, 0, 0}, {0, 0, 10}, glm::vec3(4.0F)));
    const Camera camera = patch_camera();  // below the light, which is larger than the field of view
    EXPECT_NEAR(mean_radiance(render(scene, camera, direct_light(4)).image).g, 0.9 * 4.0, 1e-4);
    std::swap(scene.lights[0].half_u, scene.lights[0].half_v);
    EXPECT_EQ(mean_radiance(render(scene, camera, direct_light(4)).image).g, 0.0);
}

TEST(Emitter, LightsLikeARectangleOfTheSameSize) {
    // Directly above the patch and off to the side, so that both light samples and BSDF samples matter.
    for (const float offset : {0.0F, 1.0F}) {
        Scene by_light = scene_of(floor_quad(), material_of(SurfaceKind::diffuse));
        by_light.lights.push_back(rectangle_light({offset - 0.5F, 0.6F, -0.5F}, {1, 0, 0}, {0, 0, 1}, glm::vec3(2.0F)));
        Scene by_mesh = scene_of(floor_quad(), material_of(SurfaceKind::diffuse));
        Material lamp = material_of(SurfaceKind::diffuse, glm::vec3(0.0F));
        lamp.emission = glm::vec3(2.0F);
        lamp.two_sided = false;
        by_mesh.materials.push_back(lamp);
        by_mesh.meshes.push_back(make_quad({offset - 0.5F, 0.6F, -0.5F}, {1, 0, 0}, {0, 0, 1}));
        by_mesh.meshes.back().material = 1;
        // Below the lamp, which hides the floor from above.
        const Camera camera = look_at_camera({0, 0.4, 0.5}, {0, 0, 0}, radians(1.0), 8, 8);
        const double expected = mean_radiance(render(by_light, camera, direct_light(512)).image).g;
        const double mean = mean_radiance(render(by_mesh, camera, direct_light(512)).image).g;
        EXPECT_GT(expected, 0.1);
        EXPECT_NEAR(mean, expected, 0.01 * expected) << offset;
    }
}

// A lamp of 1 by 1 at height 0.6 whose texture has its right half cut out, or painted black.
Scene half_lamp_scene(const RgbaF& right_half, bool painted) {
    Scene scene = scene_of(floor_quad(), material_of(SurfaceKind::diffuse));
    scene.textures.push_back({"half", Image<RgbaF>(2, 1, {1, 1, 1, 1})});
    scene.textures[0].pixels(1, 0) = right_half;
    Material lamp = material_of(SurfaceKind::diffuse, glm::vec3(0.0F));
    lamp.emission = glm::vec3(2.0F);
    lamp.two_sided = false;
    (painted ? lamp.emission_texture : lamp.texture) = 0;
    scene.materials.push_back(lamp);
    scene.meshes.push_back(make_quad({-0.5F, 0.6F, -0.5F}, {1, 0, 0}, {0, 0, 1}));
    scene.meshes.back().material = 1;
    return scene;
}

double floor_radiance(Scene scene, int samples = 1024) {
    // Below the lamp, which hides the floor from above.
    const Camera camera = look_at_camera({0, 0.4, 0.5}, {0, 0, 0}, radians(1.0), 8, 8);
    return mean_radiance(render(std::move(scene), camera, direct_light(samples)).image).g;
}

TEST(Emitter, DoesNotShineThroughItsHoles) {
    Scene half = scene_of(floor_quad(), material_of(SurfaceKind::diffuse));
    half.lights.push_back(rectangle_light({-0.5F, 0.6F, -0.5F}, {0.5F, 0, 0}, {0, 0, 1}, glm::vec3(2.0F)));
    const double expected = floor_radiance(std::move(half));
    EXPECT_GT(expected, 0.1);
    EXPECT_NEAR(floor_radiance(half_lamp_scene({1, 1, 1, 0}, false)), expected, 0.02 * expected);
}

TEST(Emitter, ShinesAsItsTextureIsPainted) {
    // The look-up is bilinear and periodic: 1 at s = 1/4, falling to 0 at 3/4 and rising again; equivalent to thin
    // strips of that radiance.
    Scene strips = scene_of(floor_quad(), material_of(SurfaceKind::diffuse));
    constexpr int kStrips = 64;
    for (int i = 0; i < kStrips; ++i) {
        const float s = (static_cast<float>(i) + 0.5F) / kStrips;
        const float away = std::abs(s - 0.75F);
        const float radiance = 2.0F * 2.0F * std::min(away, 1.0F - away);
        strips.lights.push_back(rectangle_light({s - 0.5F - 0.5F / kStrips, 0.6F, -0.5F}, {1.0F / kStrips, 0, 0},
                                                {0, 0, 1}, glm::vec3(radiance)));
    }
    const double expected = floor_radiance(std::move(strips));
    const double mean = floor_radiance(half_lamp_scene({0, 0, 0, 1}, true));
    EXPECT_NEAR(mean, expected, 0.02 * expected);
}

TEST(Emitter, OfABlackTextureIsDark) {
    Scene scene = half_lamp_scene({0, 0, 0, 1}, true);
    scene.textures[0].pixels(0, 0) = {0, 0, 0, 1};
    EXPECT_EQ(floor_radiance(std::move(scene), 4), 0.0);
}

// A dim gradient with a small bright sun.
Environment sunny_environment() {
    Environment environment;
    environment.pixels = Image<RgbaF>(64, 32);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 64; ++x) {
            const float v = 0.02F * static_cast<float>(32 - y) + 0.002F * static_cast<float>(x);
            environment.pixels(x, y) = {v, 0.5F * v, 2.0F * v, 1};
        }
    }
    environment.pixels(20, 7) = {300, 250, 200, 1};
    environment.turn_rad = 0.7F;
    environment.scale = 0.5F;
    return environment;
}

TEST(EnvironmentMap, ImportanceSamplingEqualsTheIntegral) {
    const Environment environment = sunny_environment();
    const EnvironmentMap map(environment);
    // Irradiance on an upward-facing surface, by a fine midpoint rule.
    glm::dvec3 irradiance(0);
    constexpr int kRows = 512;
    constexpr int kColumns = 2048;
    for (int y = 0; y < kRows; ++y) {
        const double polar = 0.5 * kPi * (y + 0.5) / kRows;
        for (int x = 0; x < kColumns; ++x) {
            const double phi = 2 * kPi * (x + 0.5) / kColumns;
            const glm::dvec3 d(std::sin(polar) * std::sin(phi), std::cos(polar), std::sin(polar) * std::cos(phi));
            const double weight = std::cos(polar) * std::sin(polar) * (0.5 * kPi / kRows) * (2 * kPi / kColumns);
            irradiance += glm::dvec3(map.radiance(glm::vec3(d))) * weight;
        }
    }
    Scene scene = scene_of(floor_quad(), material_of(SurfaceKind::diffuse));
    scene.environment = environment;
    const glm::dvec3 mean = mean_radiance(render(std::move(scene), patch_camera(), direct_light(1024)).image);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], irradiance[c] / kPi, 0.01 * mean[c]) << c;
}

TEST(EnvironmentMap, SamplesCarryTheirDensityWhichSumsToOne) {
    const EnvironmentMap map(sunny_environment());
    Sampler sampler(7, 0);
    for (int i = 0; i < 2000; ++i) {
        const EnvironmentMap::Sample drawn = map.sample(sampler.next_2d());
        EXPECT_NEAR(glm::length(drawn.direction), 1.0F, 1e-5F);
        EXPECT_NEAR(map.pdf(drawn.direction) / drawn.pdf, 1.0F, 1e-2F);
    }
    double sum = 0;
    for (int y = 0; y < 512; ++y) {
        const double polar = kPi * (y + 0.5) / 512;
        for (int x = 0; x < 1024; ++x) {
            const double phi = 2 * kPi * (x + 0.5) / 1024;
            const glm::vec3 d(
                glm::dvec3(std::sin(polar) * std::sin(phi), std::cos(polar), std::sin(polar) * std::cos(phi)));
            sum += static_cast<double>(map.pdf(d)) * std::sin(polar) * (kPi / 512) * (2 * kPi / 1024);
        }
    }
    EXPECT_NEAR(sum, 1.0, 2e-3);
}

TEST(EnvironmentMap, DirectionsFollowTheConvention) {
    Environment environment;
    environment.pixels = Image<RgbaF>(64, 32);
    environment.pixels(48, 16) = {1, 0, 0, 1};  // a quarter turn from the central column: +X
    environment.pixels(5, 0) = {0, 1, 0, 1};    // top row: +Y
    for (int x = 0; x < 64; ++x) environment.pixels(x, 0).g = 1;
    const EnvironmentMap map(environment);
    EXPECT_GT(map.radiance(glm::normalize(glm::vec3(1, -0.05F, 0.05F))).r, 0.5F);
    EXPECT_GT(map.radiance({0, 1, 0}).g, 0.9F);
    EXPECT_EQ(map.radiance({-1, 0, 0}).r, 0.0F);
    environment.turn_rad = kPiF / 2;  // turning +X about Y by a quarter gives -Z
    const EnvironmentMap turned(environment);
    EXPECT_GT(turned.radiance(glm::normalize(glm::vec3(0.05F, -0.05F, -1))).r, 0.5F);
}

}  // namespace
}  // namespace rs::capture::test
