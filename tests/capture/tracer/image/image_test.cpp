// Coverage, depth and holes of rendered images, and reproducibility of their bytes.

#include "tests/capture/tracer/test_shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace rs::capture::test {
namespace {

bool same_bytes(const Rendering& a, const Rendering& b) {
    return a.image.pixels().size_bytes() == b.image.pixels().size_bytes() &&
           std::memcmp(a.image.data(), b.image.data(), a.image.pixels().size_bytes()) == 0 &&
           a.depth.pixels().size_bytes() == b.depth.pixels().size_bytes() &&
           std::memcmp(a.depth.data(), b.depth.data(), a.depth.pixels().size_bytes()) == 0;
}

// A scene with many kinds of light and surface.
Scene busy_scene() {
    Scene scene = scene_of(make_sphere(3), material_of(SurfaceKind::glossy, {0.8F, 0.4F, 0.2F}));
    scene.materials.push_back(material_of(SurfaceKind::glass));
    scene.materials.push_back(material_of(SurfaceKind::metal, {0.9F, 0.8F, 0.4F}, 0.4F));
    Mesh second = make_sphere(2);
    for (glm::vec3& p : second.positions) p = p * 0.4F + glm::vec3(0.8F, 0, 0.9F);
    second.material = 1;
    scene.meshes.push_back(second);
    Mesh third = make_sphere(2);
    for (glm::vec3& p : third.positions) p = p * 0.4F + glm::vec3(-0.8F, 0.3F, 0.9F);
    third.material = 2;
    scene.meshes.push_back(third);
    scene.environment = constant_environment(0.4F);
    scene.lights.push_back(point_light({2, 3, 2}, glm::vec3(5.0F)));
    scene.lights.push_back(rectangle_light({-2, 2, 2}, {1, 0, 0}, {0, 0, 1}, glm::vec3(4.0F)));
    return scene;
}

RenderOptions with_depth(int samples, int threads = 0) {
    RenderOptions options;
    options.samples_per_pixel = samples;
    options.depth = true;
    options.threads = threads;
    return options;
}

TEST(Image, BytesDoNotDependOnThreads) {
    const Camera camera = front_camera(3.5, 36.0, 70);
    const Rendering one = render(busy_scene(), camera, with_depth(4, 1));
    for (const int threads : {2, 4})
        EXPECT_TRUE(same_bytes(one, render(busy_scene(), camera, with_depth(4, threads)))) << threads;
}

TEST(Image, SeedsAndCamerasHaveNoiseOfTheirOwn) {
    const Camera camera = front_camera(3.5, 36.0, 32);
    RenderOptions options = with_depth(2);
    const Rendering first = render(busy_scene(), camera, options);
    options.seed = 2;
    const Rendering second = render(busy_scene(), camera, options);
    EXPECT_FALSE(same_bytes(first, second));
    EXPECT_EQ(first.depth, second.depth) << "depth has no noise";

    // Views of a sphere differ in their noise only.
    Scene sphere = scene_of(make_sphere(4), material_of(SurfaceKind::diffuse));
    sphere.environment = constant_environment(1.0F);
    sphere.lights.push_back(point_light({0, 3, 0}, glm::vec3(5.0F)));
    const Rendering front = render(sphere, camera, options);
    const Rendering side = render(sphere, look_at_camera({3.5, 0, 0}, {0, 0, 0}, radians(36.0), 32, 32), options);
    EXPECT_FALSE(same_bytes(front, side));
}

TEST(Image, DepthIsThatOfTheSphere) {
    Scene scene = scene_of(make_sphere(6), material_of(SurfaceKind::diffuse));
    const Camera camera = look_at_camera({1, 2, 3}, {0.1, 0, 0}, radians(40.0), 64, 48);
    const Rendering rendering = render(std::move(scene), camera, with_depth(1));
    int inside = 0;
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            const glm::dvec3 ray = camera.ray(x + 0.5, y + 0.5);  // component 1 along the axis
            const double a = glm::dot(ray, ray);
            const double b = glm::dot(camera.centre(), ray);
            const double discriminant = b * b - a * (glm::dot(camera.centre(), camera.centre()) - 1.0);
            if (std::abs(discriminant) < 0.1) continue;
            if (discriminant < 0) {
                EXPECT_EQ(rendering.depth(x, y), 0.0F);
                EXPECT_EQ(rendering.image(x, y), RgbaF{});
            } else {
                EXPECT_NEAR(rendering.depth(x, y), (-b - std::sqrt(discriminant)) / a, 1e-3);
                ++inside;
            }
        }
    }
    EXPECT_GT(inside, 200);
}

TEST(Image, AlphaCoversTheDiscOfTheSphere) {
    Scene scene = scene_of(make_sphere(6), material_of(SurfaceKind::diffuse));
    const Camera camera = front_camera(3.0, 50.0, 64);
    const Rendering rendering = render(std::move(scene), camera, with_depth(64));
    double area_px = 0;
    for (const RgbaF& p : rendering.image.pixels()) area_px += static_cast<double>(p.a);
    const double radius_px = camera.fl_x / std::sqrt(3.0 * 3.0 - 1.0);
    EXPECT_NEAR(area_px, kPi * radius_px * radius_px, 0.002 * area_px);
}

TEST(Image, BoxFilterGivesTheExactShareOfAnEdgePixel) {
    // An edge through the centre of a column of pixels does not affect adjacent columns.
    const Camera camera = front_camera(1.0, 90.0, 8);  // 4 px per unit at the plane z = 0
    Scene scene =
        scene_of(make_quad({-10, -10, 0}, {10.0F + 0.375F, 0, 0}, {0, 20, 0}), material_of(SurfaceKind::diffuse));
    const Rendering rendering = render(std::move(scene), camera, with_depth(256));
    for (int y = 0; y < 8; ++y) {
        EXPECT_EQ(rendering.image(4, y).a, 1.0F);
        EXPECT_NEAR(rendering.image(5, y).a, 0.5F, 0.01F);
        EXPECT_EQ(rendering.image(6, y).a, 0.0F);
    }
}

TEST(Image, CameraInsideOfTheBoundsSeesEverything) {
    Scene scene = scene_of(make_sphere(3), material_of(SurfaceKind::diffuse));
    const Rendering rendering =
        render(std::move(scene), look_at_camera({0, 0, 0}, {0, 0, -1}, radians(90.0), 16, 16), with_depth(1));
    for (const RgbaF& p : rendering.image.pixels()) EXPECT_EQ(p.a, 1.0F);
}

// Left half opaque, right half a hole.
Scene half_hole_scene() {
    Scene scene = scene_of(make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), material_of(SurfaceKind::diffuse));
    Texture texture;
    texture.name = "half";
    texture.pixels = Image<RgbaF>(2, 1, {1, 1, 1, 1});
    texture.pixels(1, 0).a = 0.0F;
    scene.textures.push_back(texture);
    scene.materials[0].texture = 0;
    return scene;
}

TEST(Image, TransparentTexelsAreHoles) {
    const Rendering rendering = render(half_hole_scene(), front_camera(2.0, 40.0, 32), with_depth(4));
    EXPECT_EQ(rendering.image(8, 16).a, 1.0F);
    EXPECT_NEAR(rendering.depth(8, 16), 2.0F, 1e-4F);
    EXPECT_EQ(rendering.image(24, 16).a, 0.0F);
    EXPECT_EQ(rendering.depth(24, 16), 0.0F);
}

TEST(Image, LightFallsThroughHoles) {
    Scene scene = half_hole_scene();
    scene.materials.push_back(material_of(SurfaceKind::diffuse));
    scene.meshes.push_back(make_quad({-5, -5, -1}, {10, 0, 0}, {0, 10, 0}));  // a wall behind
    scene.meshes.back().material = 1;
    scene.lights.push_back(directional_light({0, 0, -1}, glm::vec3(3.0F)));
    // Camera between screen and wall.
    const Camera camera = look_at_camera({0, 0, -0.2}, {0, 0, -1}, radians(60.0), 32, 32);
    RenderOptions options = with_depth(4);
    options.max_bounces = 1;  // direct light only, since light from the screen's back would brighten the shadow
    const Rendering rendering = render(std::move(scene), camera, options);
    EXPECT_EQ(rendering.image(4, 16).g, 0.0F) << "in the shadow of the opaque half";
    EXPECT_NEAR(rendering.image(28, 16).g, 3.0F / 3.14159F, 1e-3F);
}

TEST(Image, TextureLiesTheRightWayUp) {
    Scene scene = scene_of(make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), material_of(SurfaceKind::diffuse));
    Texture texture;
    texture.pixels = Image<RgbaF>(2, 2, {0, 0, 0, 1});
    texture.pixels(0, 0) = {1, 0, 0, 1};  // top left
    texture.pixels(1, 1) = {0, 1, 0, 1};  // bottom right
    scene.textures.push_back(texture);
    scene.materials[0].texture = 0;
    scene.environment = constant_environment(1.0F);
    const Rendering rendering = render(std::move(scene), front_camera(2.0, 50.0, 32), with_depth(16));
    // Texel centres at +-0.5.
    EXPECT_GT(rendering.image(7, 7).r, 0.9F);
    EXPECT_GT(rendering.image(24, 24).g, 0.9F);
    EXPECT_LT(rendering.image(24, 7).r + rendering.image(24, 7).g, 0.1F);
}

TEST(Image, EmptySceneIsTransparent) {
    Scene scene;
    scene.environment = constant_environment(1.0F);
    const Rendering rendering = render(std::move(scene), front_camera(2.0, 40.0, 8), with_depth(2));
    for (const RgbaF& p : rendering.image.pixels()) EXPECT_EQ(p, RgbaF{});
}

TEST(Image, ConvertsToStraightSrgb) {
    Image<RgbaF> image(4, 1);
    image(1, 0) = {1.0F, 0.2158605F, 0.0F, 0.5F};
    image(2, 0) = {7.0F, 1e-4F, 0.5F, 1.0F};
    image(3, 0) = {1.0F, 1.0F, 1.0F, 0.001F};  // rounds to alpha 0
    const Image<Rgba8> encoded = to_srgb8(image);
    EXPECT_EQ(encoded(0, 0), (Rgba8{0, 0, 0, 0}));
    EXPECT_EQ(encoded(1, 0), (Rgba8{255, 128, 0, 128}));
    EXPECT_EQ(encoded(2, 0), (Rgba8{255, 0, 188, 255}));
    EXPECT_EQ(encoded(3, 0), (Rgba8{0, 0, 0, 0}));
}

TEST(Tracer, RefusesScenesThatCannotBeRendered) {
    const auto message = [](Scene scene) {
        const Result<Tracer> tracer = Tracer::create(std::move(scene));
        return tracer ? std::string("accepted") : tracer.error().message;
    };
    const Scene good = busy_scene();
    EXPECT_EQ(message(good), "accepted");
    Scene bad = good;
    bad.meshes[0].triangles[3].y = 1000000;
    EXPECT_NE(message(bad).find("mesh \"sphere\": a triangle refers to vertex 1000000"), std::string::npos);
    bad = good;
    bad.meshes[1].material = 9;
    EXPECT_NE(message(bad).find("material 9 does not exist"), std::string::npos);
    bad = good;
    bad.materials[0].texture = 0;
    EXPECT_NE(message(bad).find("texture 0 does not exist"), std::string::npos);
    bad = good;
    bad.meshes[0].positions[5].y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NE(message(bad).find("vertex 5 is not finite"), std::string::npos);
    bad = good;
    bad.materials[2].colour.g = 1.5F;
    EXPECT_NE(message(bad).find("colour must be within 0..1"), std::string::npos);
    bad = good;
    bad.environment.pixels(0, 0).r = -1.0F;
    EXPECT_NE(message(bad).find("environment: pixels"), std::string::npos);
}

TEST(Image, FilteredIsNearerToTheTruthAndHasTheSameOutline) {
    const Camera camera = front_camera(4, 40, 96);
    const auto drawn = [&](int samples, bool filtered) {
        RenderOptions options = with_depth(samples);
        options.filtered = filtered;
        return render(busy_scene(), camera, options);
    };
    RenderOptions other_noise = with_depth(1024);
    other_noise.seed = 7;
    const Rendering truth = render(busy_scene(), camera, other_noise);
    const auto error = [&](const Rendering& of) {
        double squares = 0;
        for (std::size_t i = 0; i < of.image.pixels().size(); ++i) {
            const RgbaF& a = of.image.pixels()[i];
            const RgbaF& b = truth.image.pixels()[i];
            const double d = static_cast<double>(a.g * a.a - b.g * b.a);
            squares += d * d;
        }
        return std::sqrt(squares);
    };
    for (const int samples : {4, 16, 64}) {
        const Rendering raw = drawn(samples, false);
        const Rendering filtered = drawn(samples, true);
        EXPECT_LT(error(filtered), (samples < 64 ? 0.8 : 1.0) * error(raw)) << samples;
        for (std::size_t i = 0; i < raw.image.pixels().size(); ++i) {
            ASSERT_EQ(filtered.image.pixels()[i].a, raw.image.pixels()[i].a);
            ASSERT_EQ(filtered.depth.pixels()[i], raw.depth.pixels()[i]);
        }
    }
}

}  // namespace
}  // namespace rs::capture::test
