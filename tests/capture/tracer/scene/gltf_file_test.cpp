// glTF and GLB files and the conversion of their materials.

#include "capture/tracer/scene/mesh_file.hpp"
#include "tests/capture/tracer/mesh_files.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>

namespace rs::capture::test {
namespace {

using rs::test::TemporaryFolder;

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

// The material of a quad with one image, whose glTF material is `changes` over an empty one.
Result<Scene> read_gltf_material(const std::filesystem::path& folder, const nlohmann::json& changes,
                                 const Image<Rgba8>& image) {
    Gltf gltf = make_gltf(nlohmann::json::object(), {{"uri", "picture.png"}});
    gltf.json["materials"][0].merge_patch(changes);
    gltf.json["buffers"] = {{{"uri", "a.bin"}, {"byteLength", gltf.buffer.size()}}};
    write_text(folder / "a.bin", gltf.buffer);
    write_text(folder / "a.gltf", gltf.json.dump());
    const Status written = write_png(folder / "picture.png", image.view());
    EXPECT_TRUE(written) << written.error().message;
    Result<Scene> scene = read_mesh_file(folder / "a.gltf");
    EXPECT_TRUE(scene) << scene.error().message;
    return scene;
}

const nlohmann::json kTexture0 = {{"index", 0}};

TEST(GltfFile, EmissionIsThatOfItsTexture) {
    const TemporaryFolder folder;
    Image<Rgba8> image(2, 1, {0, 0, 0, 255});
    image(1, 0) = {255, 188, 0, 255};
    const nlohmann::json glow = {{"emissiveFactor", {1.0, 0.5, 1.0}}, {"emissiveTexture", kTexture0}};
    const Result<Scene> scene = read_gltf_material(folder.path(), glow, image);
    const Material& material = scene->materials[static_cast<std::size_t>(scene->meshes[0].material)];
    EXPECT_EQ(material.texture, -1);
    ASSERT_EQ(material.emission_texture, 0);
    EXPECT_EQ(material.emission, glm::vec3(1.0F, 0.5F, 1.0F));
    EXPECT_EQ(scene->textures[0].pixels(0, 0), (RgbaF{0, 0, 0, 1}));
    EXPECT_NEAR(scene->textures[0].pixels(1, 0).g, 0.503F, 1e-3F) << "through the sRGB curve";
    // The emissive factor of a texture defaults to black.
    const Result<Scene> dark = read_gltf_material(folder.path(), {{"emissiveTexture", kTexture0}}, image);
    EXPECT_EQ(dark->materials[static_cast<std::size_t>(dark->meshes[0].material)].emission, glm::vec3(0.0F));
    EXPECT_TRUE(dark->textures.empty());
}

TEST(GltfFile, RoughnessAndMetalAreTheMeanOfTheirTexture) {
    const TemporaryFolder folder;
    Image<Rgba8> image(2, 1, {7, 102, 0, 255});
    image(1, 0).g = 51;
    const nlohmann::json pbr = {{"metallicRoughnessTexture", kTexture0}, {"baseColorTexture", kTexture0}};
    const Result<Scene> plastic = read_gltf_material(folder.path(), {{"pbrMetallicRoughness", pbr}}, image);
    const Material& material = plastic->materials[static_cast<std::size_t>(plastic->meshes[0].material)];
    EXPECT_EQ(material.kind, SurfaceKind::glossy) << "no blue, no metal, though the factor is 1";
    EXPECT_NEAR(material.roughness, 0.3F, 1e-5F) << "numbers, not sRGB colours";
    EXPECT_EQ(plastic->textures.size(), 1U);
    for (Rgba8& p : image.pixels()) p.b = 230;
    nlohmann::json half = pbr;
    half["roughnessFactor"] = 0.5;
    const Result<Scene> metal = read_gltf_material(folder.path(), {{"pbrMetallicRoughness", half}}, image);
    const Material& brass = metal->materials[static_cast<std::size_t>(metal->meshes[0].material)];
    EXPECT_EQ(brass.kind, SurfaceKind::metal);
    EXPECT_NEAR(brass.roughness, 0.15F, 1e-5F);
}

TEST(GltfFile, AlphaModeSaysWhatIsAHole) {
    const TemporaryFolder folder;
    Image<Rgba8> image(4, 1, {200, 0, 0, 255});
    const std::uint8_t alphas[4] = {0, 100, 180, 255};
    for (int x = 0; x < 4; ++x) image(x, 0).a = alphas[x];
    const auto holes = [&](nlohmann::json changes, double factor) {
        changes["pbrMetallicRoughness"] = {{"baseColorTexture", kTexture0}, {"baseColorFactor", {1, 1, 1, factor}}};
        const Result<Scene> scene = read_gltf_material(folder.path(), changes, image);
        std::string text;
        for (int x = 0; x < 4; ++x) {
            EXPECT_GT(scene->textures[0].pixels(x, 0).r, 0.5F) << "colours under alpha 0 are kept";
            text += scene->textures[0].pixels(x, 0).a < 0.5F ? 'o' : '#';
        }
        return text;
    };
    EXPECT_EQ(holes({}, 1), "####");
    EXPECT_EQ(holes({{"alphaMode", "OPAQUE"}}, 0.1), "####");
    EXPECT_EQ(holes({{"alphaMode", "MASK"}}, 1), "oo##");
    EXPECT_EQ(holes({{"alphaMode", "MASK"}, {"alphaCutoff", 0.8}}, 1), "ooo#");
    EXPECT_EQ(holes({{"alphaMode", "MASK"}, {"alphaCutoff", 0.2}}, 1), "o###");
    EXPECT_EQ(holes({{"alphaMode", "MASK"}}, 0.6), "ooo#") << "the factor multiplies alpha";
    EXPECT_EQ(holes({{"alphaMode", "MASK"}}, 0), "oooo");
    EXPECT_EQ(holes({{"alphaMode", "BLEND"}}, 1), "oo##");
}

TEST(GlbFile, ReadsItsEmbeddedTexture) {
    const TemporaryFolder folder;
    nlohmann::json pbr = kPaintedMetal;
    pbr["roughnessFactor"] = 1.0;
    pbr["metallicRoughnessTexture"] = kTexture0;
    Gltf gltf = make_gltf(pbr, {{"bufferView", 3}, {"mimeType", "image/png"}});
    // The mean blue is 3/4 and the mean green 2/5, the same as the factors in the other file of this material.
    Image<Rgba8> paint(2, 2, {0, 136, 255, 255});
    paint(0, 0) = {255, 0, 0, 255};
    ASSERT_TRUE(write_png(folder / "paint.png", paint.view()));
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

}  // namespace
}  // namespace rs::capture::test
