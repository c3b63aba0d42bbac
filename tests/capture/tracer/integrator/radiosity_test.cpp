// Instant radiosity against path tracing: both converge to the same image for all lights and surfaces.

#include "capture/tracer/integrator/radiosity.hpp"
#include "tests/capture/tracer/test_shapes.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace rs::capture::test {
namespace {

int add_material(Scene& scene, const Material& material) {
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
}

void add_quad(Scene& scene, int material, glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
    scene.meshes.push_back(make_quad(corner, u, v));
    scene.meshes.back().material = material;
}

// A room of 2 x 2 x 2 about the origin, open towards +Z, with a ball in it.
Scene room_with_ball(const Material& ball) {
    Scene scene;
    scene.name = "room";
    const int white = add_material(scene, material_of(SurfaceKind::diffuse, glm::vec3(0.6F)));
    const int red = add_material(scene, material_of(SurfaceKind::diffuse, {0.7F, 0.2F, 0.1F}));
    add_quad(scene, white, {-1, -1, 1}, {2, 0, 0}, {0, 0, -2});
    add_quad(scene, white, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2});
    add_quad(scene, white, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0});
    add_quad(scene, red, {-1, -1, 1}, {0, 0, -2}, {0, 2, 0});
    add_quad(scene, white, {1, -1, -1}, {0, 0, 2}, {0, 2, 0});
    const int material = add_material(scene, ball);
    scene.meshes.push_back(make_sphere(4));
    for (glm::vec3& p : scene.meshes.back().positions) p = 0.4F * p + glm::vec3(0.3F, -0.6F, 0.1F);
    scene.meshes.back().material = material;
    return scene;
}

Light ceiling_area() {
    return rectangle_light({-0.3F, 0.98F, -0.3F}, {0.6F, 0, 0}, {0, 0, 0.6F}, glm::vec3(6.0F));
}

Image<RgbaF> image_of(const Scene& scene, RenderMethod method, int samples) {
    RenderOptions options;
    options.method = method;
    options.samples_per_pixel = samples;
    options.max_bounces = 12;
    return render(Scene(scene), look_at_camera({0, 0, 3.5}, {0, 0, 0}, radians(38), 16, 16), options).image;
}

glm::dvec3 mean_of(const Image<RgbaF>& image, int x0, int y0, int x1, int y1) {
    glm::dvec3 sum(0);
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) sum += glm::dvec3(image(x, y).r, image(x, y).g, image(x, y).b);
    }
    return sum / static_cast<double>((x1 - x0) * (y1 - y0));
}

// Mean of the image and of each quarter.
void expect_same_light(const Scene& scene) {
    const Image<RgbaF> path = image_of(scene, RenderMethod::kPath, 2048);
    const Image<RgbaF> radiosity = image_of(scene, RenderMethod::kRadiosity, 256);
    const auto compare = [&](int x0, int y0, int x1, int y1, double tolerance) {
        const glm::dvec3 expected = mean_of(path, x0, y0, x1, y1), found = mean_of(radiosity, x0, y0, x1, y1);
        for (int c = 0; c < 3; ++c) {
            EXPECT_GT(expected[c], 0);
            EXPECT_NEAR(found[c], expected[c], tolerance * expected[c])
                << "channel " << c << " from " << x0 << ", " << y0;
        }
    };
    compare(0, 0, 16, 16, 0.02);
    for (int quarter = 0; quarter < 4; ++quarter) {
        const int x = quarter % 2 * 8, y = quarter / 2 * 8;
        compare(x, y, x + 8, y + 8, 0.04);
    }
}

TEST(Radiosity, FindsTheLightOfEverySourceAsPathsDo) {
    const Material matte = material_of(SurfaceKind::diffuse, {0.2F, 0.5F, 0.7F});
    const std::vector<std::pair<std::string, std::function<void(Scene&)>>> sources = {
        {"area", [](Scene& s) { s.lights.push_back(ceiling_area()); }},
        {"disc",
         [](Scene& s) {
             Light disc = ceiling_area();
             disc.kind = LightKind::kDisc;
             s.lights.push_back(disc);
         }},
        {"point",
         [](Scene& s) {
             s.lights.push_back(point_light({-0.2, 0.6, 0.2}, glm::vec3(1.0F)));
         }},
        {"dimmed as VRML97 has it",
         [](Scene& s) {
             Light light = point_light({-0.2, 0.6, 0.2}, glm::vec3(1.0F));
             light.attenuation = {0.3F, 0.2F, 0.4F};
             light.least_attenuation = 1;
             s.lights.push_back(light);
         }},
        {"spot",
         [](Scene& s) {
             Light spot = point_light({-0.5, 0.8, 0.2}, glm::vec3(4.0F));
             spot.kind = LightKind::kSpot;
             spot.towards = glm::normalize(glm::dvec3(0.3, -1, -0.2));
             spot.beam_width_rad = 0.3;
             spot.cut_off_rad = 0.7;
             s.lights.push_back(spot);
         }},
        {"sun",
         [](Scene& s) {
             s.lights.push_back(directional_light({-0.3, -0.5, -1}, glm::vec3(2.0F)));
         }},
        {"sky", [](Scene& s) { s.environment = constant_environment(1.5F); }},
        {"a ceiling that shines",
         [](Scene& s) {
             Material lamp = material_of(SurfaceKind::diffuse, glm::vec3(0.0F));
             lamp.emission = {5, 4, 3};
             lamp.two_sided = false;
             add_quad(s, add_material(s, lamp), {-0.4F, 0.9F, -0.4F}, {0.8F, 0, 0}, {0, 0, 0.8F});
         }},
        {"a ball that shines, from both sides",
         [](Scene& s) {
             s.materials.back().emission = {0.5F, 0.7F, 0.9F};
         }},
    };
    for (const auto& [name, add] : sources) {
        SCOPED_TRACE(name);
        Scene scene = room_with_ball(matte);
        add(scene);
        expect_same_light(scene);
    }
}

TEST(Radiosity, GoesByEverySurfaceAsPathsDo) {
    Material petal = material_of(SurfaceKind::diffuse, {0.8F, 0.6F, 0.7F});
    petal.translucency = 0.4F;
    for (const Material& ball :
         {material_of(SurfaceKind::mirror, glm::vec3(0.9F)), material_of(SurfaceKind::glass, {0.8F, 0.9F, 0.9F}),
          material_of(SurfaceKind::glossy, {0.2F, 0.5F, 0.7F}, 0.4F),
          material_of(SurfaceKind::metal, {0.9F, 0.7F, 0.4F}, 0.5F), petal}) {
        SCOPED_TRACE(static_cast<int>(ball.kind));
        Scene scene = room_with_ball(ball);
        scene.lights.push_back(ceiling_area());
        expect_same_light(scene);
    }
}

// A curtain close to a wall, far from the origin, so that ray offsets exceed the gap between them.
TEST(Radiosity, GoesThroughWhatHangsBeforeAWall) {
    Material cloth = material_of(SurfaceKind::diffuse, glm::vec3(0.9F));
    cloth.translucency = 0.7F;
    Scene scene = room_with_ball(material_of(SurfaceKind::diffuse, {0.2F, 0.5F, 0.7F}));
    add_quad(scene, add_material(scene, cloth), {-0.9F, -0.9F, -0.95F}, {1.8F, 0, 0}, {0, 1.8F, 0});
    scene.lights.push_back(point_light({-0.2, 0.6, 0.2}, glm::vec3(1.0F)));
    scene.lights.push_back(point_light({0.95, 0.95, -0.97}, glm::vec3(0.5F)));
    constexpr float kAway = 30;
    for (Mesh& mesh : scene.meshes) {
        for (glm::vec3& p : mesh.positions) p.x += kAway;
    }
    for (Light& light : scene.lights) light.location.x += kAway;
    const auto image = [&](RenderMethod method, int samples) {
        RenderOptions options;
        options.method = method;
        options.samples_per_pixel = samples;
        return render(Scene(scene), look_at_camera({kAway, 0, 3.5}, {kAway, 0, 0}, radians(38), 16, 16), options).image;
    };
    const Image<RgbaF> path = image(RenderMethod::kPath, 8192), radiosity = image(RenderMethod::kRadiosity, 1024);
    // Pixels of the curtain without the ball.
    const glm::dvec3 expected = mean_of(path, 4, 3, 12, 7), found = mean_of(radiosity, 4, 3, 12, 7);
    EXPECT_NEAR(found.g, expected.g, 0.04 * expected.g);
}

// Large images are interleaved: each pixel of a square has its own virtual lights.
TEST(Radiosity, InterleavedImagesHaveTheLightOfPaths) {
    Scene scene = room_with_ball(material_of(SurfaceKind::glossy, {0.2F, 0.5F, 0.7F}, 0.4F));
    scene.lights.push_back(ceiling_area());
    const auto image = [&](RenderMethod method, int side, int samples) {
        RenderOptions options;
        options.method = method;
        options.samples_per_pixel = samples;
        return render(Scene(scene), look_at_camera({0, 0, 3.5}, {0, 0, 0}, radians(38), side, side), options).image;
    };
    const Image<RgbaF> path = image(RenderMethod::kPath, 16, 2048);
    const Image<RgbaF> radiosity = image(RenderMethod::kRadiosity, 256, 12);
    for (int quarter = 0; quarter < 4; ++quarter) {
        const int x = quarter % 2, y = quarter / 2;
        const glm::dvec3 expected = mean_of(path, 8 * x, 8 * y, 8 * x + 8, 8 * y + 8);
        const glm::dvec3 found = mean_of(radiosity, 128 * x, 128 * y, 128 * x + 128, 128 * y + 128);
        EXPECT_NEAR(found.r, expected.r, 0.03 * expected.r);
        EXPECT_NEAR(found.b, expected.b, 0.03 * expected.b);
    }
}

TEST(Radiosity, PassesGiveTheSameBitsHoweverGrouped) {
    Scene scene = room_with_ball(material_of(SurfaceKind::glossy));
    scene.lights.push_back(ceiling_area());
    const Camera camera = look_at_camera({0, 0, 3.5}, {0, 0, 0}, radians(38), 33, 21);
    RenderOptions options;
    options.method = RenderMethod::kRadiosity;
    const auto traced = [&](const std::vector<int>& groups, std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const auto tracer = Tracer::create(Scene(scene));
        EXPECT_TRUE(tracer);
        Accumulation sum;
        for (const int count : groups) EXPECT_TRUE(tracer->accumulate(camera, options, count, sum));
        return sum.mean();
    };
    const Image<RgbaF> one_by_one = traced({1, 1, 1, 1, 1, 1}, 1);
    for (const Image<RgbaF>& other : {traced({6}, 4), traced({2, 3, 1}, 2)}) {
        for (int y = 0; y < camera.height; ++y) {
            for (int x = 0; x < camera.width; ++x) ASSERT_EQ(one_by_one(x, y), other(x, y)) << x << " " << y;
        }
    }
}

// The camera is in a room lit around two corners only; most virtual lights do not contribute.
TEST(Radiosity, KeepsVirtualLightsThatTheCameraSeesTheLightOf) {
    Scene scene;
    const int white = add_material(scene, material_of(SurfaceKind::diffuse, glm::vec3(0.6F)));
    add_quad(scene, white, {-4, -1, 1}, {8, 0, 0}, {0, 0, -2});
    add_quad(scene, white, {-4, 1, -1}, {8, 0, 0}, {0, 0, 2});
    add_quad(scene, white, {-4, -1, -1}, {8, 0, 0}, {0, 2, 0});
    add_quad(scene, white, {4, -1, 1}, {-8, 0, 0}, {0, 2, 0});
    add_quad(scene, white, {-4, -1, 1}, {0, 0, -2}, {0, 2, 0});
    add_quad(scene, white, {4, -1, -1}, {0, 0, 2}, {0, 2, 0});
    add_quad(scene, white, {1, -1, 1}, {0, 0, -1.5F}, {0, 2, 0});  // open at the back
    add_quad(scene, white, {0, -1, -1}, {0, 0, 1.5F}, {0, 2, 0});  // open at the front
    scene.lights.push_back(point_light({3, 0.5, 0.8}, glm::vec3(4.0F)));
    const auto rays = RayScene::create(scene);
    ASSERT_TRUE(rays);
    const LightSet lights(scene, {}, {glm::vec3(0), 4.5F});
    const auto models = make_surface_models(scene.materials);
    const LightTransport transport(scene, *rays, lights, models);
    const Camera camera = look_at_camera({-3.5, 0, 0.9}, {-1, 0, -0.5}, radians(60), 12, 12);
    const RayImage image{12, 12, camera.centre(), camera.forward(),
                         [&](double x, double y) { return camera.ray(x, y); }};
    // Image mean of each pass, and the standard deviation over the passes.
    struct Found {
        double mean, deviation, lights;
    };
    const auto found = [&](bool importance) {
        constexpr int kPasses = 512;
        const RadiosityTracer tracer(transport, {.importance = importance}, image, 7, 0, kPasses);
        double sum = 0, squares = 0;
        for (int pass = 0; pass < kPasses; ++pass) {
            double of_pass = 0;
            for (int pixel = 0; pixel < 144; ++pixel) {
                Sampler sampler(mix_bits(static_cast<std::uint64_t>(pixel)), static_cast<std::uint32_t>(pass));
                const glm::dvec3 ray = glm::normalize(camera.ray(pixel % 12 + 0.5, pixel / 12 + 0.5));
                glm::vec3 radiance;
                tracer.trace(glm::vec3(camera.centre()), glm::vec3(ray), 0.0F, sampler, radiance);
                of_pass += static_cast<double>(radiance.g) / 144;
            }
            sum += of_pass;
            squares += of_pass * of_pass;
        }
        const double mean = sum / kPasses;
        return Found{mean, std::sqrt(squares / kPasses - mean * mean) / mean,
                     static_cast<double>(tracer.light_count()) / kPasses};
    };
    const Found off = found(false), on = found(true);
    EXPECT_NEAR(on.mean, off.mean, 4 * off.deviation / std::sqrt(512.0) * off.mean);
    EXPECT_NEAR(on.lights, off.lights, 0.35 * off.lights);
    // The error is proportional to the inverse root of the number of lights: equal to a third of the lights.
    EXPECT_LT(on.deviation, off.deviation / std::sqrt(3.0))
        << on.lights << " lights a pass; " << off.lights << " without";
    RecordProperty("off", std::to_string(off.deviation));
    RecordProperty("on", std::to_string(on.deviation));
}

}  // namespace
}  // namespace rs::capture::test
