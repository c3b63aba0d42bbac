// Every mesh format, written here byte by byte, and every way in which a file can be wrong.

#include "capture/tracer/mesh_file.hpp"
#include "rayspace/picture_io.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>

namespace rs::capture {
namespace {

using rs::test::TemporaryFolder;
using testing::HasSubstr;

void write_text(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

std::string read_bytes(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// 2x2: red at the top left, everything else blue.
void write_texture(const std::filesystem::path& path) {
    Image<Rgba8> picture(2, 2, {0, 0, 255, 255});
    picture(0, 0) = {255, 0, 0, 255};
    const Status written = write_png(path, picture.view());
    ASSERT_TRUE(written) << written.error().message;
}

std::string error_of(const std::filesystem::path& path) {
    const Result<Scene> scene = read_mesh_file(path);
    if (scene) return "read without an error";
    EXPECT_EQ(scene.error().message.find('\n'), std::string::npos) << "errors are one line";
    return scene.error().message;
}

constexpr const char* kQuad = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

TEST(ObjFile, ReadsMaterialsAndTexture) {
    const TemporaryFolder folder;
    write_text(folder / "a.obj",
               std::string("mtllib a.mtl\n") + kQuad + "usemtl painted\nf 1/1 2/2 3/3 4/4\nusemtl shiny\nf 1 2 3\n");
    write_text(folder / "a.mtl",
               "newmtl painted\nKd 0.5 0.5 0.5\nmap_Kd paint.png\nillum 1\n"
               "newmtl shiny\nKd 0.1 0.2 0.3\nKs 0.5 0.5 0.5\nNs 30\nillum 2\nKe 0 1 0\n");
    write_texture(folder / "paint.png");
    const Result<Scene> scene = read_mesh_file(folder / "a.obj");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->meshes.size(), 2U);
    ASSERT_EQ(scene->textures.size(), 1U);
    EXPECT_EQ(scene->textures[0].name, "paint.png");
    EXPECT_EQ(scene->textures[0].pixels(0, 0), (RgbaF{1, 0, 0, 1}));
    std::size_t triangles = 0;
    for (const Mesh& mesh : scene->meshes) {
        const Material& material = scene->materials[static_cast<std::size_t>(mesh.material)];
        triangles += mesh.triangles.size();
        ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
        for (const glm::vec3& n : mesh.normals) EXPECT_NEAR(n.z, 1.0F, 1e-5F);
        if (material.name == "painted") {
            EXPECT_EQ(material.kind, SurfaceKind::diffuse);
            EXPECT_EQ(material.texture, 0);
            ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
            for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
                EXPECT_EQ(mesh.uvs[i].x, mesh.positions[i].x > 0 ? 1.0F : 0.0F);
                EXPECT_EQ(mesh.uvs[i].y, mesh.positions[i].y > 0 ? 1.0F : 0.0F);
            }
        } else {
            EXPECT_EQ(material.name, "shiny");
            EXPECT_EQ(material.kind, SurfaceKind::glossy);
            EXPECT_EQ(material.texture, -1);
            EXPECT_NEAR(material.roughness, 0.5F, 1e-5F);  // (2 / 32)^(1/4)
            EXPECT_NEAR(material.colour.b, 0.3F, 1e-6F);
            EXPECT_EQ(material.emission.g, 1.0F);
        }
    }
    EXPECT_EQ(triangles, 3U);
}

TEST(ObjFile, MirrorAndGlassFollowIllum) {
    const TemporaryFolder folder;
    write_text(folder / "a.obj", std::string("mtllib a.mtl\n") + kQuad + "usemtl m\nf 1 2 3\nusemtl g\nf 1 3 4\n");
    write_text(
        folder / "a.mtl",
        "newmtl m\nKd 0 0 0\nKs 0.9 0.9 0.9\nNs 1000\nillum 5\nnewmtl g\nKd 0 0 0\nKs 1 1 1\nNi 1.33\nillum 7\n");
    const Result<Scene> scene = read_mesh_file(folder / "a.obj");
    ASSERT_TRUE(scene) << scene.error().message;
    int found = 0;
    for (const Material& material : scene->materials) {
        if (material.name == "m") {
            EXPECT_EQ(material.kind, SurfaceKind::mirror);
            EXPECT_NEAR(material.colour.r, 0.9F, 1e-6F);
            ++found;
        } else if (material.name == "g") {
            EXPECT_EQ(material.kind, SurfaceKind::glass);
            EXPECT_NEAR(material.ior, 1.33F, 1e-6F);
            ++found;
        }
    }
    EXPECT_EQ(found, 2);
}

TEST(ObjFile, MissingMaterialFileMeansGrey) {
    const TemporaryFolder folder;
    write_text(folder / "a.obj", std::string("mtllib gone.mtl\n") + kQuad + "usemtl x\nf 1 2 3\n");
    const Result<Scene> scene = read_mesh_file(folder / "a.obj");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->materials[static_cast<std::size_t>(scene->meshes[0].material)].kind, SurfaceKind::diffuse);
}

TEST(ObjFile, CreasesStaySharpAndGentleEdgesAreSmoothed) {
    const TemporaryFolder folder;
    // Two faces that meet at 90 degrees along the Y axis, and two at about 23.
    write_text(folder / "a.obj", "v 0 0 0\nv 0 1 0\nv 1 0 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n");
    write_text(folder / "b.obj", "v 0 0 0\nv 0 1 0\nv 1 0 -0.2\nv -1 0 -0.2\nf 1 3 2\nf 1 2 4\n");
    const Result<Scene> sharp = read_mesh_file(folder / "a.obj");
    const Result<Scene> smooth = read_mesh_file(folder / "b.obj");
    ASSERT_TRUE(sharp && smooth);
    const auto different_normals_at_origin = [](const Mesh& mesh) {
        std::vector<glm::vec3> normals;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            if (glm::length(mesh.positions[i]) > 1e-6F) continue;
            const bool known = std::ranges::any_of(
                normals, [&](const glm::vec3& n) { return glm::length(n - mesh.normals[i]) < 1e-3F; });
            if (!known) normals.push_back(mesh.normals[i]);
        }
        return normals.size();
    };
    EXPECT_EQ(different_normals_at_origin(sharp->meshes[0]), 2U);
    EXPECT_EQ(different_normals_at_origin(smooth->meshes[0]), 1U);
}

TEST(PlyFile, ReadsVerticesAndPolygons) {
    const TemporaryFolder folder;
    write_text(folder / "a.ply",
               "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
               "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
               "0 0 0\n2 0 0\n2 2 0\n0 2 0\n4 0 1 2 3\n");
    const Result<Scene> scene = read_mesh_file(folder / "a.ply");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->meshes[0].triangles.size(), 2U);
    EXPECT_EQ(scene->meshes[0].normals.size(), scene->meshes[0].positions.size());
}

TEST(PlyFile, BinaryOfBothEndiannesses) {
    const TemporaryFolder folder;
    for (const bool big : {false, true}) {
        std::string body;
        const auto append = [&](auto value) {
            char bytes[sizeof value];
            std::memcpy(bytes, &value, sizeof value);
            if (big) std::reverse(bytes, bytes + sizeof value);
            body.append(bytes, sizeof value);
        };
        for (const float v : {0.0F, 0.0F, 0.0F, 3.0F, 0.0F, 0.0F, 0.0F, 3.0F, 0.0F}) append(v);
        append(std::uint8_t{3});
        for (const std::int32_t i : {0, 1, 2}) append(i);
        const std::string header =
            std::string("ply\nformat binary_") + (big ? "big" : "little") +
            "_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
        write_text(folder / "a.ply", header + body);
        const Result<Scene> scene = read_mesh_file(folder / "a.ply");
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_EQ(scene->meshes[0].triangles.size(), 1U);
        float largest = 0;
        for (const glm::vec3& p : scene->meshes[0].positions) largest = std::max(largest, p.x);
        EXPECT_EQ(largest, 3.0F);
        // Cut off at every byte: never read, never endless.
        for (std::size_t size = 0; size < header.size() + body.size(); ++size) {
            write_text(folder / "cut.ply", (header + body).substr(0, size));
            EXPECT_THAT(error_of(folder / "cut.ply"), HasSubstr("cut.ply: ")) << size;
        }
    }
}

TEST(PlyFile, ErrorsNameTheElement) {
    const TemporaryFolder folder;
    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    write_text(folder / "a.ply", header + "0 0 0\n1 0 0\n0 x 0\n3 0 1 2\n");
    EXPECT_THAT(error_of(folder / "a.ply"), HasSubstr("vertex 2: y is missing or no number"));
    write_text(folder / "a.ply", header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
    EXPECT_THAT(error_of(folder / "a.ply"), HasSubstr("face 0: a face names a vertex that does not exist"));
    write_text(folder / "a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty quaternion x\nend_header\n");
    EXPECT_THAT(error_of(folder / "a.ply"), HasSubstr("unknown type \"quaternion\""));
    write_text(folder / "a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n");
    EXPECT_THAT(error_of(folder / "a.ply"), HasSubstr("has no faces"));
    write_text(folder / "a.ply", "not a mesh at all\n");
    EXPECT_THAT(error_of(folder / "a.ply"), HasSubstr("is not a PLY file"));
}

// A quad with positions, texture coordinates (glTF: v down) and one material with a texture.
struct Gltf {
    nlohmann::json json;
    std::string buffer;
};

Gltf make_gltf(const nlohmann::json& pbr, const nlohmann::json& image) {
    Gltf gltf;
    const float positions[12] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    const float uvs[8] = {0, 1, 1, 1, 1, 0, 0, 0};
    const std::uint16_t indices[6] = {0, 1, 2, 0, 2, 3};
    gltf.buffer.append(reinterpret_cast<const char*>(positions), sizeof positions);
    gltf.buffer.append(reinterpret_cast<const char*>(uvs), sizeof uvs);
    gltf.buffer.append(reinterpret_cast<const char*>(indices), sizeof indices);
    gltf.json = {
        {"asset", {{"version", "2.0"}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0}}}}},
        {"nodes", {{{"mesh", 0}, {"translation", {0, 0, 5}}}}},
        {"meshes",
         {{{"primitives", {{{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}, {"indices", 2}, {"material", 0}}}}}}},
        {"materials", {{{"name", "skin"}, {"pbrMetallicRoughness", pbr}}}},
        {"textures", {{{"source", 0}}}},
        {"images", {image}},
        {"accessors",
         {{{"bufferView", 0},
           {"componentType", 5126},
           {"count", 4},
           {"type", "VEC3"},
           {"min", {-1, -1, 0}},
           {"max", {1, 1, 0}}},
          {{"bufferView", 1}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}},
          {{"bufferView", 2}, {"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}}}},
        {"bufferViews",
         {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 48}},
          {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 32}},
          {{"buffer", 0}, {"byteOffset", 80}, {"byteLength", 12}}}},
    };
    return gltf;
}

const nlohmann::json kPaintedMetal = {{"baseColorFactor", {0.5, 0.25, 1.0, 1.0}},
                                      {"baseColorTexture", {{"index", 0}}},
                                      {"metallicFactor", 1.0},
                                      {"roughnessFactor", 0.4}};

void expect_painted_metal(const Result<Scene>& scene) {
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->meshes.size(), 1U);
    const Mesh& mesh = scene->meshes[0];
    const Material& material = scene->materials[static_cast<std::size_t>(mesh.material)];
    EXPECT_EQ(material.name, "skin");
    EXPECT_EQ(material.kind, SurfaceKind::metal);
    EXPECT_NEAR(material.roughness, 0.4F, 1e-6F);
    EXPECT_NEAR(material.colour.g, 0.25F, 1e-6F);
    ASSERT_EQ(material.texture, 0);
    EXPECT_EQ(scene->textures[0].pixels(0, 0), (RgbaF{1, 0, 0, 1}));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_NEAR(mesh.positions[i].z, 5.0F, 1e-6F) << "the node's translation";
        EXPECT_NEAR(mesh.uvs[i].y, mesh.positions[i].y > 0 ? 1.0F : 0.0F, 1e-6F) << "our v grows upwards";
    }
}

TEST(GltfFile, ReadsMaterialTextureAndNodeTransform) {
    const TemporaryFolder folder;
    Gltf gltf = make_gltf(kPaintedMetal, {{"uri", "my%20paint.png"}});
    gltf.json["buffers"] = {{{"uri", "a.bin"}, {"byteLength", gltf.buffer.size()}}};
    write_text(folder / "a.bin", gltf.buffer);
    write_text(folder / "a.gltf", gltf.json.dump());
    write_texture(folder / "my paint.png");
    expect_painted_metal(read_mesh_file(folder / "a.gltf"));
}

TEST(GltfFile, RoughPlasticIsGlossy) {
    const TemporaryFolder folder;
    Gltf gltf = make_gltf({{"metallicFactor", 0.0}, {"roughnessFactor", 0.7}}, {{"uri", "unused.png"}});
    gltf.json["buffers"] = {{{"uri", "a.bin"}, {"byteLength", gltf.buffer.size()}}};
    write_text(folder / "a.bin", gltf.buffer);
    write_text(folder / "a.gltf", gltf.json.dump());
    const Result<Scene> scene = read_mesh_file(folder / "a.gltf");
    ASSERT_TRUE(scene) << scene.error().message;
    const Material& material = scene->materials[static_cast<std::size_t>(scene->meshes[0].material)];
    EXPECT_EQ(material.kind, SurfaceKind::glossy);
    EXPECT_EQ(material.colour, glm::vec3(1.0F));
    EXPECT_NEAR(material.roughness, 0.7F, 1e-6F);
}

TEST(GlbFile, ReadsItsEmbeddedTexture) {
    const TemporaryFolder folder;
    write_texture(folder / "paint.png");
    Gltf gltf = make_gltf(kPaintedMetal, {{"bufferView", 3}, {"mimeType", "image/png"}});
    const std::string png = read_bytes(folder / "paint.png");
    gltf.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", gltf.buffer.size()}, {"byteLength", png.size()}});
    gltf.buffer += png;
    gltf.buffer.resize((gltf.buffer.size() + 3) / 4 * 4, '\0');
    gltf.json["buffers"] = {{{"byteLength", gltf.buffer.size()}}};
    std::string text = gltf.json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string file;
    const auto append_word = [&](std::uint32_t word) { file.append(reinterpret_cast<const char*>(&word), 4); };
    append_word(0x46546C67);  // "glTF"
    append_word(2);
    append_word(static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + gltf.buffer.size()));
    append_word(static_cast<std::uint32_t>(text.size()));
    append_word(0x4E4F534A);  // "JSON"
    file += text;
    append_word(static_cast<std::uint32_t>(gltf.buffer.size()));
    append_word(0x004E4942);  // "BIN"
    file += gltf.buffer;
    write_text(folder / "a.glb", file);
    std::filesystem::remove(folder / "paint.png");
    expect_painted_metal(read_mesh_file(folder / "a.glb"));
}

TEST(MeshFile, ErrorsNameTheFileAndTheReason) {
    const TemporaryFolder folder;
    EXPECT_THAT(error_of(folder / "gone.obj"), HasSubstr("gone.obj: there is no such file"));
    write_text(folder / "a.txt", "hello");
    EXPECT_THAT(error_of(folder / "a.txt"), HasSubstr("use .obj, .ply, .gltf or .glb"));
    write_text(folder / "points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    EXPECT_THAT(error_of(folder / "points.obj"), HasSubstr("points.obj"));
    write_text(folder / "line.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n");
    EXPECT_THAT(error_of(folder / "line.obj"), HasSubstr("line.obj"));
    write_text(folder / "broken.gltf", "{\"asset\": ");
    EXPECT_THAT(error_of(folder / "broken.gltf"), HasSubstr("broken.gltf: cannot be read as a mesh"));
    write_text(folder / "nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n");
    write_text(folder / "huge.obj", "v 0 0 0\nv 1 1e39 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_THAT(error_of(folder / "huge.obj"), HasSubstr("vertex 1 of mesh"));
    EXPECT_THAT(error_of(folder / "nan.obj"), HasSubstr("is not finite; repair the mesh"));
}

TEST(MeshFile, MissingTextureIsNamedWithTheFileThatAsks) {
    const TemporaryFolder folder;
    write_text(folder / "a.obj", std::string("mtllib a.mtl\n") + kQuad + "usemtl p\nf 1/1 2/2 3/3\n");
    write_text(folder / "a.mtl", "newmtl p\nmap_Kd lost.png\n");
    const std::string message = error_of(folder / "a.obj");
    EXPECT_THAT(message, HasSubstr("a.obj: asks for the texture"));
    EXPECT_THAT(message, HasSubstr("lost.png"));
}

TEST(MeshFile, KnowsItsNameEndings) {
    EXPECT_TRUE(is_mesh_file("a.OBJ"));
    EXPECT_TRUE(is_mesh_file("x/b.glb"));
    EXPECT_TRUE(is_mesh_file("b.gltf"));
    EXPECT_TRUE(is_mesh_file("b.ply"));
    EXPECT_FALSE(is_mesh_file("b.stl"));
    EXPECT_FALSE(is_mesh_file("obj"));
}

}  // namespace
}  // namespace rs::capture
