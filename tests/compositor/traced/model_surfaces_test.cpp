// Materials of model files in traced renderers: the viewer's images equal those of the capture pipeline's reader.

#include "capture/tracer/integrator/tracer.hpp"
#include "capture/tracer/scene/mesh_file.hpp"
#include "compositor/scene/reader/scene_file.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "rayspace/geometry/camera.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

namespace rs::compositor {
namespace {

constexpr int kSide_px = 96;
constexpr int kSamples = 256;

// A sphere with vertex normals about (x, 0.5, 0), and a floor.
std::string sphere(double x, int& vertices) {
    constexpr int kStacks = 24, kSlices = 48;
    constexpr double kRadius = 0.45;
    std::string text;
    for (int stack = 0; stack <= kStacks; ++stack) {
        for (int slice = 0; slice < kSlices; ++slice) {
            const double polar = kPi * stack / kStacks, turn = 2 * kPi * slice / kSlices;
            const glm::dvec3 n(std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn));
            const glm::dvec3 p = kRadius * n + glm::dvec3(x, 0.5, 0);
            text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\nvn " +
                    std::to_string(n.x) + " " + std::to_string(n.y) + " " + std::to_string(n.z) + "\n";
        }
    }
    const auto at = [&](int stack, int slice) {
        const std::string index = std::to_string(vertices + stack * kSlices + slice % kSlices + 1);
        return " " + index + "//" + index;
    };
    for (int stack = 0; stack < kStacks; ++stack) {
        for (int slice = 0; slice < kSlices; ++slice) {
            text +=
                "f" + at(stack, slice) + at(stack, slice + 1) + at(stack + 1, slice + 1) + at(stack + 1, slice) + "\n";
        }
    }
    vertices += (kStacks + 1) * kSlices;
    return text;
}

constexpr const char* kMtl =
    "newmtl matte\nKd 0.7 0.3 0.2\nillum 1\n"
    "newmtl mirror\nKd 0 0 0\nKs 0.9 0.9 0.9\nNs 1000\nillum 3\n"
    "newmtl glass\nKd 0 0 0\nKs 1 1 1\nNs 1000\nNi 1.5\nd 0.1\nillum 7\n"
    "newmtl gold\nKd 1 0.77 0.34\nPm 1\nPr 0.3\nillum 2\n"
    "newmtl floor\nKd 0.5 0.5 0.5\nillum 1\n";

std::string spheres() {
    std::string text = "mtllib spheres.mtl\n";
    int vertices = 0;
    double x = -1.5;
    for (const char* const material : {"matte", "mirror", "glass", "gold"}) {
        text += "usemtl " + std::string(material) + "\n" + sphere(x++, vertices);
    }
    text += "usemtl floor\n";
    for (const auto& [u, v] : {std::pair(-4, 4), {4, 4}, {4, -4}, {-4, -4}}) {
        text += "v " + std::to_string(u) + " 0 " + std::to_string(v) + "\n";
    }
    for (int i = 1; i <= 4; ++i) text += (i == 1 ? "f " : " ") + std::to_string(vertices + i);
    return text + "\n";
}

EnvironmentLight sky() {
    Image<RgbaF> pixels(16, 8);
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 16; ++x) {
            const float above = y < 4 ? 1.0F : 0.2F;
            pixels(x, y) = {above * (x < 8 ? 1.2F : 0.5F), above * 0.8F, above * (x < 8 ? 0.5F : 1.2F), 1};
        }
    }
    EnvironmentLight light;
    light.pixels = std::make_shared<const Image<RgbaF>>(std::move(pixels));
    return light;
}

double psnr(const Image<Rgba8>& a, const Image<Rgba8>& b) {
    double sum = 0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            const glm::dvec3 d =
                glm::dvec3(a(x, y).r, a(x, y).g, a(x, y).b) - glm::dvec3(b(x, y).r, b(x, y).g, b(x, y).b);
            sum += glm::dot(d, d);
        }
    }
    return 10 * std::log10(255.0 * 255.0 * 3 * a.width() * a.height() / std::max(sum, 1e-9));
}

TEST(ModelSurfaces, MatteMirrorGlassAndGoldEqualTheCapturePipelines) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "spheres.mtl") << kMtl;
    std::ofstream(folder / "spheres.obj") << spheres();
    const Camera camera = look_at_camera({0, 1.6, 4.2}, {0, 0.4, 0}, 0.9, kSide_px, kSide_px / 2);

    Result<capture::Scene> meshes = capture::read_mesh_file(folder / "spheres.obj");
    ASSERT_TRUE(meshes) << meshes.error().message;
    meshes->environment = {*sky().pixels, 1, 0};
    const auto tracer = capture::Tracer::create(std::move(*meshes));
    ASSERT_TRUE(tracer) << tracer.error().message;
    capture::RenderOptions options;
    options.samples_per_pixel = kSamples;
    const Image<Rgba8> expected = capture::to_srgb8(tracer->render(camera, options).image);

    Result<Scene> scene = read_scene(folder / "spheres.obj");
    ASSERT_TRUE(scene) << scene.error().message;
    scene->environment = sky();
    auto renderer = TracedRenderer::create(*scene, {}, {.method = TracedMethod::kPath});
    ASSERT_TRUE(renderer) << renderer.error().message;
    renderer->begin_image(camera);
    for (int pass = 0; pass < kSamples; ++pass) ASSERT_TRUE(renderer->add_pass());
    const Image<Rgba8> shown = capture::to_srgb8(renderer->radiance());
    EXPECT_GT(psnr(shown, expected), 35);
}

TEST(ModelSurfaces, OpenGlassStaysBlended) {
    GeometryNode pane;
    auto mesh = std::make_shared<Mesh>(box_mesh({1, 1, 1}));
    pane.mesh = mesh;
    pane.material.opacity = 0.2F;
    EXPECT_TRUE(is_traced(pane));
    auto open = std::make_shared<Mesh>(*mesh);
    open->indices.resize(open->indices.size() - 3);
    pane.mesh = open;
    EXPECT_FALSE(is_traced(pane));
    pane.material.opacity = 0.7F;
    pane.mesh = mesh;
    EXPECT_FALSE(is_traced(pane));
}

TEST(ModelSurfaces, PhongMaterialsBecomeSurfaces) {
    Material material;
    material.diffuse = glm::vec3(0);
    material.specular = {1, 0.77F, 0.34F};
    material.shininess = 0.5F;
    EXPECT_EQ(surface_of(material).kind, rs::SurfaceKind::metal);
    EXPECT_EQ(surface_of(material).colour, material.specular);
    material.shininess = 1;
    EXPECT_EQ(surface_of(material).kind, rs::SurfaceKind::mirror);
    material.diffuse = glm::vec3(0.3F);
    EXPECT_EQ(surface_of(material).kind, rs::SurfaceKind::glossy);
    material.specular = glm::vec3(0);
    EXPECT_EQ(surface_of(material).kind, rs::SurfaceKind::diffuse);
    material.opacity = 0.1F;
    EXPECT_EQ(surface_of(material).kind, rs::SurfaceKind::glass);
}

}  // namespace
}  // namespace rs::compositor
