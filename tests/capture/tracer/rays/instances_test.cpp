// Instances of parts against the flattened scene, and ray time against analytic formulas.

#include "capture/tracer/rays/ray_scene.hpp"
#include "capture/tracer/scene/scene_transform.hpp"
#include "tests/capture/tracer/test_shapes.hpp"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace rs::capture::test {
namespace {

RenderOptions options_of(RenderMethod method, int samples) {
    RenderOptions options;
    options.method = method;
    options.samples_per_pixel = samples;
    options.max_bounces = 4;
    return options;
}

glm::dmat4 moved_by(const glm::dvec3& way) {
    return glm::translate(glm::dmat4(1), way);
}

// A texture with holes in a quarter of its area.
Texture lattice_texture() {
    Texture texture;
    texture.pixels = Image<RgbaF>(8, 8, {0.9F, 0.8F, 0.3F, 1});
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
            if (x % 2 == 1 && y % 2 == 1) texture.pixels(x, y).a = 0;
        }
    }
    return texture;
}

// A static floor; balls, a lattice and a lamp as rotated, stretched and mirrored instances.
Scene moving_scene() {
    Scene scene;
    scene.name = "moving";
    scene.textures = {lattice_texture()};
    scene.materials = {material_of(SurfaceKind::diffuse, glm::vec3(0.7F)),
                       material_of(SurfaceKind::glossy, {0.6F, 0.2F, 0.1F}),
                       material_of(SurfaceKind::diffuse, glm::vec3(1.0F)), material_of(SurfaceKind::diffuse)};
    scene.materials[2].texture = 0;
    scene.materials[3].emission = {6, 5, 4};
    scene.meshes = {make_quad({-8, -1, 8}, {16, 0, 0}, {0, 0, -16})};
    Mesh ball = make_sphere(3);
    for (const glm::vec3& p : ball.positions) ball.colours.push_back(0.5F + 0.5F * p);
    ball.material = 1;
    Mesh lattice = make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    lattice.material = 2;
    Mesh lamp = make_quad({-0.5F, 0, -0.5F}, {1, 0, 0}, {0, 0, 1});
    lamp.material = 3;
    scene.parts = {{"ball", {ball}}, {"lattice and lamp", {lattice, lamp}}};
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1), 0.7, glm::normalize(glm::dvec3(1, 2, 0.5)));
    scene.instances = {
        {0, moved_by({-1.5, 0, 0}) * turned * glm::scale(glm::dmat4(1), {0.5, 1.4, 0.8})},
        {0, moved_by({1.4, 0, -0.5}) * glm::scale(glm::dmat4(1), {-1, 0.6, 1}) * turned},
        {1, moved_by({0, 0.3, 1.2}) * glm::scale(glm::dmat4(1), {0.6, 0.6, -0.6}) * turned},
        {1, moved_by({0, 2.5, -0.5}) * glm::rotate(glm::dmat4(1), 0.2, {0, 0, 1})},
    };
    scene.lights = {point_light({2, 5, 4}, glm::vec3(40))};
    return scene;
}

Camera moving_camera(int side) {
    return look_at_camera({0.4, 1.5, 6}, {0, 0, 0}, radians(50), side, side);
}

Tracer tracer_of(Scene scene) {
    Result<Tracer> tracer = Tracer::create(std::move(scene));
    RS_CHECK(tracer.ok());
    return std::move(*tracer);
}

struct Difference {
    int pixels = 0;       // that differ by more than rounding
    double of_means = 0;  // relative
};

Difference difference_of(const Image<RgbaF>& a, const Image<RgbaF>& b) {
    Difference difference;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            const RgbaF &p = a(x, y), &q = b(x, y);
            const float apart = std::max({std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.a - q.a)});
            difference.pixels += apart > 1e-3F + 1e-3F * std::max(p.r, q.r);
        }
    }
    difference.of_means = mean_radiance(a).g / mean_radiance(b).g - 1;
    return difference;
}

// Deterministic rendering: pixels may differ only at edges.
TEST(Instances, LookAsWhenFlattened) {
    const Scene scene = moving_scene();
    const Image<RgbaF> instanced = render(scene, moving_camera(160), options_of(RenderMethod::kWhitted, 1)).image;
    const Image<RgbaF> flat = render(flattened(scene), moving_camera(160), options_of(RenderMethod::kWhitted, 1)).image;
    EXPECT_LT(difference_of(instanced, flat).pixels, 160 * 160 / 1000);
    // The instances are visible.
    Scene empty = scene;
    empty.instances.clear();
    const Image<RgbaF> bare = render(std::move(empty), moving_camera(160), options_of(RenderMethod::kWhitted, 1)).image;
    EXPECT_GT(difference_of(bare, flat).pixels, 160 * 160 / 4);
}

TEST(Instances, ShineAndAreLitAsWhenFlattened) {
    const Scene scene = moving_scene();
    for (const RenderMethod method : {RenderMethod::kPath, RenderMethod::kRadiosity}) {
        const Image<RgbaF> instanced = render(scene, moving_camera(16), options_of(method, 64)).image;
        const Image<RgbaF> flat = render(flattened(scene), moving_camera(16), options_of(method, 64)).image;
        EXPECT_NEAR(difference_of(instanced, flat).of_means, 0, 0.015);
    }
}

TEST(Instances, MovesBuildNoTriangleTreeAgainAndGiveTheBitsOfANewScene) {
    Scene scene = moving_scene();
    Tracer tracer = tracer_of(scene);
    const Tracer::Builds before = tracer.builds();
    EXPECT_EQ(before.triangle_trees, 3);  // static meshes and two parts
    for (int step = 1; step <= 20; ++step) {
        for (std::size_t i = 0; i < scene.instances.size(); ++i) {
            scene.instances[i].world_from_part =
                moved_by({0.05 * step, 0, 0.02 * static_cast<double>(i)}) * scene.instances[i].world_from_part;
            ASSERT_TRUE(tracer.move(i, scene.instances[i].world_from_part));
        }
        tracer.commit();
    }
    EXPECT_EQ(tracer.builds().triangle_trees, before.triangle_trees);
    EXPECT_EQ(tracer.builds().instance_trees, before.instance_trees + 20);
    tracer.commit();  // nothing has moved
    EXPECT_EQ(tracer.builds().instance_trees, before.instance_trees + 20);
    const RenderOptions options = options_of(RenderMethod::kPath, 2);
    EXPECT_EQ(tracer.render(moving_camera(48), options).image, render(scene, moving_camera(48), options).image);
}

TEST(Instances, ALampThatIsCarriedAwayTakesItsLightAlong) {
    Scene scene;
    scene.materials = {material_of(SurfaceKind::diffuse, glm::vec3(0.8F)), material_of(SurfaceKind::diffuse)};
    scene.materials[1].emission = glm::vec3(4);
    scene.meshes = {make_quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100})};
    Mesh lamp = make_quad({-0.1F, 3, -0.1F}, {0.2F, 0, 0}, {0, 0, 0.2F});
    lamp.material = 1;
    scene.parts = {{"lamp", {lamp}}};
    scene.instances = {{0}};
    Tracer tracer = tracer_of(scene);
    const Camera camera = look_at_camera({5, 1, 0.5}, {5, 0, 0}, radians(1), 4, 4);
    ASSERT_TRUE(tracer.move(0, moved_by({5, 0, 0})));
    tracer.commit();
    const double expected = 0.8 * 4 * 0.04 / (kPi * 9);
    for (const RenderMethod method : {RenderMethod::kPath, RenderMethod::kWhitted}) {
        const double found = mean_radiance(tracer.render(camera, options_of(method, 256)).image).g;
        EXPECT_NEAR(found, expected, 0.01 * expected);
    }
}

TEST(Instances, MatricesWithoutAnInverseAreRefused) {
    Scene scene = moving_scene();
    Tracer tracer = tracer_of(scene);
    const glm::dmat4 flat = glm::scale(glm::dmat4(1), {1, 0, 1});
    const Status refused = tracer.move(1, flat);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("instance 2"), std::string::npos) << refused.error().message;
    EXPECT_FALSE(tracer.move(1, moved_by({std::nan(""), 0, 0})));
    EXPECT_FALSE(tracer.move(1, glm::dmat4(1), flat));
    scene.instances[2].part = 7;
    const auto none = Tracer::create(scene);
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("instance 3: part 7 does not exist"), std::string::npos);
}

// An emissive square of width 1 that moves by 2 in x while the shutter is open: a trapezoid.
TEST(RayTime, AMovingSquareIsSeenForAsLongAsItIsThere) {
    Scene scene;
    scene.materials = {material_of(SurfaceKind::diffuse, glm::vec3(0.0F))};
    scene.materials[0].emission = glm::vec3(1);
    scene.parts = {{"square", {make_quad({-0.5F, -4, 0}, {1, 0, 0}, {0, 8, 0})}}};
    scene.instances = {{0, moved_by({-1, 0, 0}), moved_by({1, 0, 0})}};
    Camera camera = look_at_camera({0, 0, 100}, {0, 0, 0}, radians(2), 64, 1);
    const double width = 2 * 100 * std::tan(radians(1)) / 64;  // of a pixel
    for (const RenderMethod method : {RenderMethod::kPath, RenderMethod::kWhitted, RenderMethod::kRadiosity}) {
        const Image<RgbaF> image = render(scene, camera, options_of(method, 1024)).image;
        for (int x = 0; x < 64; ++x) {
            const double at = (x - 31.5) * width;
            const double first = std::clamp((at - 0.5 + 1) / 2, 0.0, 1.0),
                         last = std::clamp((at + 0.5 + 1) / 2, 0.0, 1.0);
            EXPECT_NEAR(static_cast<double>(image(x, 0).a), last - first, 0.02) << x;
        }
    }
}

// Shadows and reflected light use the time of the path: path tracing and radiosity agree.
TEST(RayTime, PathAndRadiosityAgreeOnABlurredRoom) {
    Scene scene = moving_scene();
    for (Instance& instance : scene.instances) {
        instance.at_close = moved_by({0.8, 0.2, 0.3}) * instance.world_from_part;
    }
    scene.materials[3].emission = glm::vec3(0);
    const Image<RgbaF> path = render(scene, moving_camera(16), options_of(RenderMethod::kPath, 256)).image;
    const Image<RgbaF> radiosity = render(scene, moving_camera(16), options_of(RenderMethod::kRadiosity, 128)).image;
    EXPECT_NEAR(difference_of(path, radiosity).of_means, 0, 0.015);
    // Moving emissive surfaces are hit by paths only.
    scene.materials[3].emission = {6, 5, 4};
    for (Instance& instance : scene.instances) instance.at_close = instance.world_from_part;
    Scene still = scene;
    for (Instance& instance : still.instances) instance.at_close.reset();
    const Image<RgbaF> met = render(scene, moving_camera(16), options_of(RenderMethod::kPath, 512)).image;
    const Image<RgbaF> drawn = render(still, moving_camera(16), options_of(RenderMethod::kPath, 512)).image;
    EXPECT_NEAR(difference_of(met, drawn).of_means, 0, 0.015);
}

TEST(RayTime, MatricesGoEvenly) {
    Scene scene;
    scene.materials = {material_of(SurfaceKind::diffuse)};
    scene.parts = {{"square", {make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})}}};
    scene.instances = {{0, glm::dmat4(1), moved_by({0, 0, 4})}};
    const auto rays = RayScene::create(scene);
    ASSERT_TRUE(rays);
    EXPECT_TRUE(rays->blurred());
    for (const float time : {0.0F, 0.25F, 0.5F, 0.99F}) {
        SurfacePoint point;
        ASSERT_TRUE(rays->intersect({0.2F, 0.3F, 10}, {0, 0, -1}, time, point));
        EXPECT_NEAR(point.distance, 10 - 4 * time, 1e-5);
        EXPECT_NEAR(point.position.z, 4 * time, 1e-5);
        EXPECT_FALSE(rays->occluded({0.2F, 0.3F, 10}, {0, 0, -1}, 9.9F - 4 * time, time));
        EXPECT_TRUE(rays->occluded({0.2F, 0.3F, 10}, {0, 0, -1}, 10.1F - 4 * time, time));
    }
}

}  // namespace
}  // namespace rs::capture::test
