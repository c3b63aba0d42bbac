// Published meshes and light probes, rendered small.

#include "capture/tracer/scene/mesh_file.hpp"
#include "capture/tracer/scene/scene_file.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/capture/tracer/test_shapes.hpp"
#include "tests/support/real_data.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <string>

namespace rs::capture::test {
namespace {

RenderOptions quick(int samples = 8) {
    RenderOptions options;
    options.samples_per_pixel = samples;
    return options;
}

double coverage_px(const Image<RgbaF>& image) {
    double sum = 0;
    for (const RgbaF& p : image.pixels()) sum += static_cast<double>(p.a);
    return sum;
}

TEST(RealScene, SpotWithItsTextureIsWhiteWithDarkSpots) {
    const auto mesh = RS_REAL_DATA_OR_SKIP("meshes/spot/spot_triangulated.obj");
    const rs::test::TemporaryFolder folder;
    const nlohmann::json recipe = {
        {"object",
         {{"mesh", std::filesystem::absolute(mesh).string()},
          {"texture", std::filesystem::absolute(mesh.parent_path() / "spot_texture.png").string()}}},
        {"environment", {{"constant", 1}}}};
    std::ofstream(folder / "spot.json") << recipe.dump();
    Result<SceneFile> file = load_scene_file(folder / "spot.json", {});
    ASSERT_TRUE(file) << file.error().message;
    // From the side.
    const Camera camera = look_at_camera({3.5, 0, 0}, {0, 0, 0}, radians(39.3), 64, 64);
    const Rendering rendering = render(std::move(file->scene), camera, quick());
    int light = 0;
    int dark = 0;
    for (const RgbaF& p : rendering.image.pixels()) {
        if (p.a < 1.0F) continue;
        light += p.g > 0.6F ? 1 : 0;
        dark += p.g < 0.25F ? 1 : 0;
    }
    EXPECT_GT(coverage_px(rendering.image), 400);
    EXPECT_GT(light, 100);
    EXPECT_GT(dark, 20);
}

TEST(RealScene, BunnyAndSuzanneLoseNoEnergyInTheFurnace) {
    for (const char* name : {"meshes/suzanne.obj", "meshes/stanford-bunny.obj"}) {
        const auto path = RS_REAL_DATA_OR_SKIP(name);
        Result<SceneFile> file = load_scene_file(path, {});
        ASSERT_TRUE(file) << file.error().message;
        file->scene.environment = constant_environment(1.0F);
        for (Material& material : file->scene.materials) material = material_of(SurfaceKind::diffuse);
        const Rendering rendering = render(std::move(file->scene), front_camera(3.5, 39.3, 48), quick(32));
        // Concave: light is caught in folds until the path's last bounce, and behind normals that disagree with facets.
        EXPECT_NEAR(mean_radiance(rendering.image).g, 1.0, 0.02) << name;
    }
}

TEST(RealScene, CornellBoxHasItsColours) {
    const auto path = RS_REAL_DATA_OR_SKIP("meshes/cornell/CornellBox-Original.obj");
    Result<Scene> scene = read_mesh_file(path);
    ASSERT_TRUE(scene) << scene.error().message;
    const Camera camera = look_at_camera({0, 1, 4}, {0, 1, 0}, radians(34.0), 48, 48);
    const Rendering rendering = render(std::move(*scene), camera, quick(64));
    const RgbaF left = rendering.image(5, 24);
    const RgbaF right = rendering.image(42, 24);
    EXPECT_GT(left.r, 3 * left.g) << "the red wall";
    EXPECT_GT(right.g, 1.5F * right.r) << "the green wall";
    EXPECT_GT(rendering.image(24, 20).g, 0.02F) << "the back wall is lit";
}

TEST(RealScene, EveryCornellBoxReads) {
    for (const char* name : {"Original", "Glossy", "Mirror", "Sphere"}) {
        const auto path = RS_REAL_DATA_OR_SKIP(std::string("meshes/cornell/CornellBox-") + name + ".obj");
        const Result<SceneFile> file = load_scene_file(path, {});
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_GE(file->scene.meshes.size(), 6U);
        EXPECT_TRUE(std::ranges::any_of(file->scene.materials, [](const Material& m) { return m.emission.r > 0.0F; }))
            << name;
        if (std::string(name) == "Mirror") {
            EXPECT_TRUE(std::ranges::any_of(file->scene.materials,
                                            [](const Material& m) { return m.kind == SurfaceKind::mirror; }));
        }
    }
}

TEST(RealScene, LightProbesLightAWhiteBallByTheirMean) {
    for (const char* name : {"studio.exr", "interior.exr", "courtyard.exr", "pisa.hdr"}) {
        const auto path = RS_REAL_DATA_OR_SKIP(std::string("hdr/") + name);
        const rs::test::TemporaryFolder folder;
        std::ofstream(folder / "ball.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        const nlohmann::json recipe = {{"object", {{"mesh", "ball.obj"}}},
                                       {"environment", {{"file", std::filesystem::absolute(path).string()}}}};
        std::ofstream(folder / "ball.json") << recipe.dump();
        Result<SceneFile> file = load_scene_file(folder / "ball.json", {});
        ASSERT_TRUE(file) << file.error().message;
        const Image<RgbaF>& map = file->scene.environment.pixels;
        // The mean over the sphere of irradiance / pi of a white surface is the mean radiance of the probe.
        double mean = 0;
        double weight = 0;
        for (int y = 0; y < map.height(); ++y) {
            const double solid_angle = std::sin(kPi * (y + 0.5) / map.height());
            for (int x = 0; x < map.width(); ++x) {
                mean += solid_angle * static_cast<double>(map(x, y).g);
                weight += solid_angle;
            }
        }
        mean /= weight;
        Scene scene = scene_of(make_sphere(3), material_of(SurfaceKind::diffuse));
        scene.environment = file->scene.environment;
        const Result<Tracer> tracer = Tracer::create(std::move(scene));
        ASSERT_TRUE(tracer) << tracer.error().message;
        // Six cameras see every normal about equally: the pixels of one view are weighted by the cosine to it.
        double seen = 0;
        for (const glm::dvec3& eye : {glm::dvec3(40, 0, 0), glm::dvec3(-40, 0, 0), glm::dvec3(0, 40, 1e-3),
                                      glm::dvec3(0, -40, 1e-3), glm::dvec3(0, 0, 40), glm::dvec3(0, 0, -40)}) {
            const Camera camera = look_at_camera(eye, {0, 0, 0}, radians(3.0), 24, 24);
            seen += mean_radiance(tracer->render(camera, quick(64)).image).g / 6;
        }
        EXPECT_NEAR(seen, mean, 0.06 * mean) << name;
    }
}

}  // namespace
}  // namespace rs::capture::test
