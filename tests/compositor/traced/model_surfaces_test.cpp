// Materials of model files in traced renderers: the viewer's images equal those of the capture pipeline's reader.

#include "capture/tracer/integrator/tracer.hpp"
#include "capture/tracer/scene/mesh_file.hpp"
#include "compositor/scene/reader/scene_file.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "rayspace/geometry/camera.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace rs::compositor {
namespace {

constexpr int kSide_px = 64;
constexpr int kSamples = 32;

constexpr double kRadius = 0.45;

// Vertices and quadrilaterals of a sphere about (x, 0.5, 0), or of the floor.
struct Shape {
    std::vector<glm::vec3> positions, normals;
    std::vector<std::array<std::uint32_t, 4>> faces;
};

Shape sphere_at(double x) {
    constexpr std::uint32_t kStacks = 24, kSlices = 48;
    Shape shape;
    for (std::uint32_t stack = 0; stack <= kStacks; ++stack) {
        for (std::uint32_t slice = 0; slice < kSlices; ++slice) {
            const double polar = kPi * stack / kStacks, turn = 2 * kPi * slice / kSlices;
            const glm::dvec3 n(std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn));
            shape.positions.emplace_back(kRadius * n + glm::dvec3(x, 0.5, 0));
            shape.normals.emplace_back(n);
            if (stack == kStacks) continue;
            const std::uint32_t row = stack * kSlices, next = (slice + 1) % kSlices;
            shape.faces.push_back({row + slice, row + next, row + kSlices + next, row + kSlices + slice});
        }
    }
    return shape;
}

Shape floor_below() {
    return {{{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}}, std::vector<glm::vec3>(4, {0, 1, 0}), {{0, 1, 2, 3}}};
}

struct NamedShape {
    const char* material;
    Shape shape;
};

std::vector<NamedShape> spheres() {
    return {{"matte", sphere_at(-1.5)},
            {"mirror", sphere_at(-0.5)},
            {"glass", sphere_at(0.5)},
            {"gold", sphere_at(1.5)},
            {"floor", floor_below()}};
}

constexpr const char* kMtl =
    "newmtl matte\nKd 0.7 0.3 0.2\nillum 1\n"
    "newmtl mirror\nKd 0 0 0\nKs 0.9 0.9 0.9\nNs 1000\nillum 3\n"
    "newmtl glass\nKd 0 0 0\nKs 1 1 1\nNs 1000\nNi 1.5\nd 0.1\nillum 7\n"
    "newmtl gold\nKd 1 0.77 0.34\nPm 1\nPr 0.3\nillum 2\n"
    "newmtl floor\nKd 0.5 0.5 0.5\nillum 1\n";

void write_obj(const test::TemporaryFolder& folder) {
    std::ofstream(folder / "spheres.mtl") << kMtl;
    std::ofstream out(folder / "spheres.obj");
    out << "mtllib spheres.mtl\n";
    std::size_t vertices = 1;
    for (const auto& [material, shape] : spheres()) {
        out << "usemtl " << material << "\n";
        for (const glm::vec3& p : shape.positions) out << "v " << p.x << " " << p.y << " " << p.z << "\n";
        for (const glm::vec3& n : shape.normals) out << "vn " << n.x << " " << n.y << " " << n.z << "\n";
        for (const auto& face : shape.faces) {
            out << "f";
            for (const std::uint32_t i : face) out << " " << vertices + i << "//" << vertices + i;
            out << "\n";
        }
        vertices += shape.positions.size();
    }
}

constexpr const char* kGltfMaterials = R"([
    {"pbrMetallicRoughness": {"baseColorFactor": [0.7, 0.3, 0.2, 1], "metallicFactor": 0, "roughnessFactor": 1}},
    {"pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.9, 0.9, 1], "metallicFactor": 1, "roughnessFactor": 0}},
    {"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}},
    {"pbrMetallicRoughness": {"baseColorFactor": [1, 0.77, 0.34, 1], "metallicFactor": 1, "roughnessFactor": 0.3}},
    {"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0, "roughnessFactor": 1}}])";

void write_gltf(const test::TemporaryFolder& folder) {
    std::ofstream data(folder / "spheres.bin", std::ios::binary);
    std::string views, accessors, primitives;
    std::size_t offset = 0;
    int view = 0;
    const auto add = [&](const auto& values, int component, const char* type, std::size_t count,
                         const std::string& bounds) {
        const std::size_t bytes = values.size() * sizeof(values[0]);
        data.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(bytes));
        const std::string comma = view == 0 ? "" : ", ";
        views += comma + R"({"buffer": 0, "byteOffset": )" + std::to_string(offset) + R"(, "byteLength": )" +
                 std::to_string(bytes) + "}";
        accessors += comma + R"({"bufferView": )" + std::to_string(view) + R"(, "componentType": )" +
                     std::to_string(component) + R"(, "count": )" + std::to_string(count) + R"(, "type": ")" + type +
                     "\"" + bounds + "}";
        offset += bytes;
        return view++;
    };
    int material = 0;
    for (const auto& [name, shape] : spheres()) {
        std::vector<std::uint32_t> indices;
        for (const auto& f : shape.faces) indices.insert(indices.end(), {f[0], f[1], f[2], f[0], f[2], f[3]});
        const std::string bounds = R"(, "min": [-4, 0, -4], "max": [4, 1, 4])";
        const int positions = add(shape.positions, 5126, "VEC3", shape.positions.size(), bounds);
        const int normals = add(shape.normals, 5126, "VEC3", shape.normals.size(), "");
        const int triangles = add(indices, 5125, "SCALAR", indices.size(), "");
        primitives += std::string(material == 0 ? "" : ", ") + R"({"attributes": {"POSITION": )" +
                      std::to_string(positions) + R"(, "NORMAL": )" + std::to_string(normals) + R"(}, "indices": )" +
                      std::to_string(triangles) + R"(, "material": )" + std::to_string(material) + "}";
        ++material;
    }
    std::ofstream(folder / "spheres.gltf")
        << R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_transmission"], "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "buffers": [{"uri": "spheres.bin", "byteLength": )"
        << offset << R"(}], "bufferViews": [)" << views << R"(], "accessors": [)" << accessors << R"(], "materials": )"
        << kGltfMaterials << R"(, "meshes": [{"primitives": [)" << primitives << "]}]}";
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

// PSNR of the viewer's image by path tracing against that of the capture pipeline.
double agreement_dB(const std::filesystem::path& file) {
    const Camera camera = look_at_camera({0, 1.6, 4.2}, {0, 0.4, 0}, 0.9, kSide_px, kSide_px / 2);
    Result<capture::Scene> meshes = capture::read_mesh_file(file);
    Result<Scene> scene = read_scene(file);
    EXPECT_TRUE(meshes) << meshes.error().message;
    EXPECT_TRUE(scene) << scene.error().message;
    if (!meshes || !scene) return 0;
    std::set<capture::SurfaceKind> kinds;
    for (const capture::Material& material : meshes->materials) kinds.insert(material.kind);
    EXPECT_TRUE(kinds.contains(capture::SurfaceKind::metal) && kinds.contains(capture::SurfaceKind::glass));

    meshes->environment = {*sky().pixels, 1, 0};
    const auto tracer = capture::Tracer::create(std::move(*meshes));
    EXPECT_TRUE(tracer) << tracer.error().message;
    capture::RenderOptions options;
    options.samples_per_pixel = kSamples;
    const Image<Rgba8> expected = capture::to_srgb8(tracer->render(camera, options).image);

    scene->lights.clear();
    scene->environment = sky();
    auto renderer = TracedRenderer::create(*scene, {}, {.method = TracedMethod::kPath});
    EXPECT_TRUE(renderer) << renderer.error().message;
    renderer->begin_image(camera);
    for (int pass = 0; pass < kSamples; ++pass) EXPECT_TRUE(renderer->add_pass());
    return psnr(capture::to_srgb8(renderer->radiance()), expected);
}

TEST(ModelSurfaces, MatteMirrorGlassAndGoldEqualTheCapturePipelines) {
    const test::TemporaryFolder folder;
    write_obj(folder);
    write_gltf(folder);
    EXPECT_GT(agreement_dB(folder / "spheres.obj"), 60);
    EXPECT_GT(agreement_dB(folder / "spheres.gltf"), 60);
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
