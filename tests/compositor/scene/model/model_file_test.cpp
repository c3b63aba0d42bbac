#include "compositor/scene/model/model_file.hpp"

#include "compositor/scene/material.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <set>

namespace rs::compositor {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

// Positions and texture coordinates of a triangle.
constexpr float kData[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 1, 0, 0};
// The triangle in a data URI or, if `binary`, in the chunk of a .glb; `nodes`, materials and the rest are inserted.
std::string gltf(const std::string& nodes, const std::string& more = "", bool binary = false) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(kData);
    static const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string base64;
    for (std::size_t i = 0; i < sizeof kData; i += 3) {
        const unsigned word = bytes[i] << 16U | bytes[i + 1] << 8U | bytes[i + 2];
        for (int shift = 18; shift >= 0; shift -= 6) base64 += kDigits[word >> shift & 63U];
    }
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [)" + nodes +
           R"(], "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
        "buffers": [{"byteLength": 60)" +
           (binary ? "" : R"(, "uri": "data:application/octet-stream;base64,)" + base64 + '"') + R"(}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                      {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}])" +
           more + "}";
}
constexpr const char* kMaterial =
    R"(, "materials": [{"doubleSided": true, "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 1], "metallicFactor": 0}}])";

class ModelFile : public ::testing::Test {
protected:
    Result<Scene> read(const std::string& text, const std::string& name = "hall.gltf") const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return read_model(folder_ / name);
    }
    test::TemporaryFolder folder_;
};

constexpr const char* kPlyVertices =
    "property float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
    "property uchar blue\n";
constexpr const char* kPlyBody = "0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 188 0 0\n";

TEST_F(ModelFile, PlyMeshesHaveTheColoursOfTheirVertices) {
    const auto scene =
        read(std::string("ply\nformat ascii 1.0\nelement vertex 3\n") + kPlyVertices +
                 "element face 1\nproperty list uchar int vertex_indices\nend_header\n" + kPlyBody + "3 0 1 2\n",
             "scan.PLY");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(scene->navigation.headlight);
    ASSERT_EQ(scene->geometry.size(), 1U);
    const Mesh& mesh = *scene->geometry[0].mesh;
    EXPECT_EQ(mesh.topology, Topology::kTriangles);
    EXPECT_TRUE(mesh.two_sided);
    ASSERT_EQ(mesh.indices.size(), 3U);
    ASSERT_TRUE(mesh.has_colours);
    EXPECT_FLOAT_EQ(mesh.vertices[mesh.indices[0]].colour.r, 1);
    EXPECT_NEAR(mesh.vertices[mesh.indices[2]].colour.r, 0.503, 0.001) << "linear light";
    EXPECT_EQ(scene->geometry[0].material.specular, glm::vec3(0));
}

TEST_F(ModelFile, PlyFilesWithoutFacesArePoints) {
    const std::string cloud =
        std::string("ply\nformat ascii 1.0\nelement vertex 3\n") + kPlyVertices + "end_header\n" + kPlyBody;
    const auto scene = read(cloud, "scan.ply");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->geometry.size(), 1U);
    const Mesh& mesh = *scene->geometry[0].mesh;
    EXPECT_EQ(mesh.topology, Topology::kPoints);
    EXPECT_EQ(mesh.indices.size(), 3U);
    EXPECT_TRUE(mesh.has_colours);
    EXPECT_FALSE(scene->geometry[0].material.lit);
    const auto cut = read(cloud.substr(0, cloud.size() - 8), "cut.ply");
    ASSERT_FALSE(cut);
    EXPECT_THAT(cut.error().message, HasSubstr("cut.ply: "));
}

TEST_F(ModelFile, MeshesMaterialsAndTransformsAreRead) {
    const auto scene =
        read(gltf(R"({"children": [1], "translation": [1, 0, 0]}, {"mesh": 0, "scale": [2, 3, 4]})", kMaterial));
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->geometry.size(), 1U);
    const GeometryNode& node = scene->geometry[0];
    EXPECT_EQ(node.mesh->indices.size(), 3U);
    EXPECT_TRUE(node.mesh->two_sided);
    EXPECT_LT(glm::distance(node.material.diffuse, glm::vec3(0.5F, 0.25F, 1)), 1e-5F);
    EXPECT_LT(glm::distance(glm::dvec3(node.world_from_node * glm::dvec4(1, 1, 1, 1)), glm::dvec3(3, 3, 4)), 1e-5);
    for (const MeshVertex& vertex : node.mesh->vertices) {
        EXPECT_LT(glm::distance(vertex.normal, glm::vec3(0, 0, 1)), 1e-5F);
        // t increases upwards.
        EXPECT_LT(glm::distance(vertex.texture, glm::vec2(vertex.position)), 1e-5F);
    }
    EXPECT_TRUE(scene->navigation.headlight);
    EXPECT_THAT(scene->warnings, IsEmpty());
}

TEST_F(ModelFile, ExtrasStandForObjects) {
    const auto scene = read(gltf(
        R"({"children": [1], "translation": [1, 0, 0], "rotation": [0, 0.70710678, 0, 0.70710678]},
           {"mesh": 0, "name": "Vase", "scale": [2, 2, 2], "translation": [0, 0, 1],
            "extras": {"RaySpace": {"url": "objects/vase.rso", "size": 0.5, "standing": false}, "other": 1}})",
        kMaterial));
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->objects.size(), 1U);
    const RaySpaceNode& object = scene->objects[0];
    EXPECT_EQ(object.file, folder_ / "objects/vase.rso");
    EXPECT_EQ(object.description, "Vase");
    EXPECT_FALSE(object.standing);
    // (0, 1, 2) scaled by 1/2 and 2, translated to (0, 1, 3), rotated to (3, 1, 0), translated.
    EXPECT_LT(glm::distance(world_from_node(object.chain).point({0, 1, 2}), glm::dvec3(4, 1, 0)), 1e-6);
}

TEST_F(ModelFile, ExtrasStandForRooms) {
    const auto scene = read(gltf(
        R"({"children": [1], "translation": [1, 0, 0],
            "extras": {"RaySpaceRoom": {"centre": [0, 1, 0], "size": [4, 2, 4], "description": "hall"}}},
           {"mesh": 0, "extras": {"RaySpace": {"url": "vase.rso"}}})",
        kMaterial));
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->rooms.size(), 1U);
    EXPECT_EQ(scene->rooms[0].description, "hall");
    EXPECT_EQ(scene->rooms[0].box.lowest, glm::dvec3(-1, 0, -2));
    ASSERT_EQ(scene->objects.size(), 1U);
    EXPECT_EQ(scene->objects[0].room, 0U);
}

TEST_F(ModelFile, AFaultInExtrasIsAnErrorThatNamesItsPlace) {
    for (const auto& [extras, expected] :
         {std::pair{R"({"RaySpace": {"size": 1}})", "nodes[0].extras.RaySpace: url is missing"},
          std::pair{R"({"RaySpace": {"url": "a.rso", "size": 0}})", "nodes[0].extras.RaySpace.size: must be a number"},
          std::pair{R"({"RaySpace": {"url": "a.rso", "hue": 0}})", "has a key 'hue'"},
          std::pair{R"({"RaySpace": {"url": "http://a/b.rso"}})", "not a local file"}}) {
        const auto scene = read(gltf(R"({"mesh": 0, "extras": )" + std::string(extras) + "}", kMaterial));
        ASSERT_FALSE(scene) << extras;
        EXPECT_THAT(scene.error().message, ::testing::AllOf(HasSubstr("hall.gltf: "), HasSubstr(expected)));
    }
}

TEST_F(ModelFile, CamerasAndLightsAreRead) {
    const auto scene = read(gltf(
        R"({"mesh": 0, "children": [1, 2]}, {"camera": 0, "translation": [0, 2, 5]},
           {"translation": [0, 3, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}})",
        std::string(kMaterial) +
            R"(, "cameras": [{"type": "perspective", "name": "door", "perspective": {"yfov": 0.7, "znear": 0.1, "aspectRatio": 1.5}}],
               "extensionsUsed": ["KHR_lights_punctual"],
               "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "name": "lamp", "intensity": 10, "color": [1, 0.5, 0]}]}})"));
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->viewpoints.size(), 1U);
    EXPECT_EQ(scene->viewpoints[0].description, "door");
    EXPECT_DOUBLE_EQ(scene->viewpoints[0].field_of_view_rad, 0.7);
    EXPECT_EQ(glm::dvec3(scene->viewpoints[0].world_from_camera[3]), glm::dvec3(0, 2, 5));
    ASSERT_EQ(scene->lights.size(), 1U);
    EXPECT_EQ(scene->lights[0].kind, LightKind::kPoint);
    EXPECT_EQ(scene->lights[0].name, "lamp");
    EXPECT_EQ(scene->lights[0].location, glm::dvec3(0, 3, 0));
    EXPECT_NEAR(scene->lights[0].colour.g, 5 / kPi, 1e-5);
    EXPECT_FALSE(scene->navigation.headlight);
}

TEST_F(ModelFile, ImagesBesideTheFileModulate) {
    ASSERT_TRUE(write_png(folder_ / "grain.png", Image<Rgba8>(4, 4, Rgba8{255, 0, 0, 0})).ok());
    const auto scene = read(gltf(R"({"mesh": 0})",
                                 R"(, "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}], "images": [{"uri": "grain.png"}])"));
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_TRUE(scene->geometry.at(0).material.texture);
    EXPECT_TRUE(scene->geometry[0].material.texture->modulates);
    EXPECT_FALSE(scene->geometry[0].material.texture->has_alpha) << "an opaque material ignores alpha";
    EXPECT_FALSE(scene->geometry[0].mesh->two_sided);
}

TEST_F(ModelFile, NormalAndBumpMapsBecomeRelief) {
    ASSERT_TRUE(write_png(folder_ / "bent.png", Image<Rgba8>(4, 4, Rgba8{255, 128, 255, 255})).ok());
    Image<Rgba8> step(4, 4, Rgba8{0, 0, 0, 255});
    for (int y = 0; y < 4; ++y) step(2, y) = step(3, y) = {255, 255, 255, 255};
    ASSERT_TRUE(write_png(folder_ / "step.png", step).ok());
    const auto bent = read(gltf(R"({"mesh": 0})", R"(, "materials": [{"normalTexture": {"index": 0, "scale": 0.5}}],
        "textures": [{"source": 0}], "images": [{"uri": "bent.png"}])"));
    ASSERT_TRUE(bent) << bent.error().message;
    ASSERT_TRUE(bent->geometry.at(0).material.normals);
    EXPECT_EQ(bent->geometry[0].material.normals->directions(1, 1), (RgbaF{0.5F, 0, 1, 1}));
    EXPECT_FALSE(bent->geometry[0].material.texture);

    const std::string triangle =
        "mtllib hall.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n";
    const auto of_mtl = [&](const std::string& lines) {
        std::ofstream(folder_ / "hall.mtl") << "newmtl m\nKd 0.5 0.5 0.5\n" << lines;
        return read(triangle, "hall.obj");
    };
    for (const char* keyword : {"map_bump", "map_Bump", "bump"}) {
        const auto scene = of_mtl(keyword + std::string(" -bm 0.25 step.png\n"));
        ASSERT_TRUE(scene) << scene.error().message;
        ASSERT_TRUE(scene->geometry.at(0).material.normals) << keyword;
        EXPECT_FLOAT_EQ(scene->geometry[0].material.normals->directions(1, 1).r, -0.25F * 4) << keyword;
    }
    const auto scene = of_mtl("norm bent.png\n");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_TRUE(scene->geometry.at(0).material.normals);
    EXPECT_EQ(scene->geometry[0].material.normals->directions(0, 0), (RgbaF{1, 0, 1, 1}));
}

TEST_F(ModelFile, ABinaryFileIsRead) {
    std::string json = gltf(R"({"mesh": 0, "extras": {"RaySpace": {"url": "a.rso"}}})", kMaterial, true);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto word = [](std::size_t value) {
        const auto narrow = static_cast<std::uint32_t>(value);
        std::string bytes(4, '\0');
        std::memcpy(bytes.data(), &narrow, 4);
        return bytes;
    };
    const std::string data(reinterpret_cast<const char*>(kData), sizeof kData);
    const std::string glb = "glTF" + word(2) + word(28 + json.size() + data.size()) + word(json.size()) + "JSON" +
                            json + word(data.size()) + std::string("BIN\0", 4) + data;
    const auto scene = read(glb, "hall.glb");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->geometry.size(), 1U);
    EXPECT_EQ(scene->objects.size(), 1U);
    const auto cut = read(glb.substr(0, 40), "cut.glb");
    ASSERT_FALSE(cut);
    EXPECT_THAT(cut.error().message, HasSubstr("cut.glb: is a damaged .glb file"));
}

TEST_F(ModelFile, UnsupportedExtensionsAreRefusedIfRequiredAndReportedIfNot) {
    const auto optional = read(
        gltf(R"({"mesh": 0})", std::string(kMaterial) + R"(, "extensionsUsed": ["EXT_none", "KHR_materials_unlit"])"));
    ASSERT_TRUE(optional) << optional.error().message;
    EXPECT_THAT(optional->warnings, ElementsAre(HasSubstr("EXT_none is not supported")));
    const auto required =
        read(gltf(R"({"mesh": 0})",
                  std::string(kMaterial) + R"(, "extensionsUsed": ["EXT_none"], "extensionsRequired": ["EXT_none"])"));
    ASSERT_FALSE(required);
    EXPECT_THAT(required.error().message, HasSubstr("hall.gltf: requires the glTF extension EXT_none"));
}

TEST_F(ModelFile, ContentThatIsIgnoredIsReported) {
    const auto scene = read(gltf(
        R"({"mesh": 0, "camera": 0})",
        std::string(kMaterial) +
            R"(, "cameras": [{"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "zfar": 9, "znear": 1}}],
                "skins": [{"joints": [0]}])"));
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_THAT(scene->warnings, UnorderedElementsAre(HasSubstr("skins are ignored"),
                                                      HasSubstr("camera 0 is not a perspective one; left out")));
    const auto named = read(gltf(R"({"mesh": 0, "name": "animations"})", std::string(kMaterial) + R"(, "skins": [])"));
    ASSERT_TRUE(named) << named.error().message;
    EXPECT_THAT(named->warnings, IsEmpty());
}

TEST_F(ModelFile, TextureTransformsMoveTextureCoordinates) {
    ASSERT_TRUE(write_png(folder_ / "a b.png", Image<Rgba8>(2, 2, Rgba8{255, 0, 0, 255}).view()).ok());
    const auto of_gltf = read(gltf(R"({"mesh": 0})", R"(, "materials": [{"pbrMetallicRoughness": {"baseColorTexture":
        {"index": 0, "extensions": {"KHR_texture_transform": {"scale": [3, 2]}}}}}], "textures": [{"extensions":
        {"EXT_texture_webp": {"source": 0}}}], "images": [{"uri": "a%20b.png"}],
        "extensionsUsed": ["KHR_texture_transform", "EXT_texture_webp"])"));
    ASSERT_TRUE(of_gltf) << of_gltf.error().message;
    EXPECT_THAT(of_gltf->warnings, IsEmpty());
    ASSERT_TRUE(of_gltf->geometry.at(0).material.texture);
    const auto width = [](const Scene& scene) {
        float low = 1e9F, high = -1e9F;
        for (const MeshVertex& vertex : scene.geometry.at(0).mesh->vertices) {
            low = std::min(low, vertex.texture.x);
            high = std::max(high, vertex.texture.x);
        }
        return high - low;
    };
    EXPECT_FLOAT_EQ(width(*of_gltf), 3);
    std::ofstream(folder_ / "my hall.mtl") << "newmtl m\nMAP_KD -s 4 1 1 A%20B.png\n";
    const auto of_obj = read(
        "mtllib my hall.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n", "hall.obj");
    ASSERT_TRUE(of_obj) << of_obj.error().message;
    ASSERT_TRUE(of_obj->geometry.at(0).material.texture);
    EXPECT_FLOAT_EQ(width(*of_obj), 4);
}

// Coordinates of the colour texture by KHR_texture_transform (offset + rotation * scale * uv, v downwards), and by
// MTL's -s and -o (scale * uv + offset).
TEST_F(ModelFile, TextureTransformsAreExact) {
    ASSERT_TRUE(write_png(folder_ / "a.png", Image<Rgba8>(2, 2, Rgba8{255, 0, 0, 255}).view()).ok());
    const auto with = [&](const std::string& transform) {
        return read(gltf(R"({"mesh": 0})", R"(, "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0,
        "extensions": {"KHR_texture_transform": {)" +
                                               transform + R"(}}}}}], "textures": [{"source": 0}],
        "images": [{"uri": "a.png"}], "extensionsUsed": ["KHR_texture_transform"])"));
    };
    for (const double angle : {0.0, 0.5, -2.0}) {
        const auto scene = with(R"("scale": [2, 3], "offset": [1.25, -0.1], "rotation": )" + std::to_string(angle));
        ASSERT_TRUE(scene) << scene.error().message;
        const std::vector<MeshVertex>& vertices = scene->geometry.at(0).mesh->vertices;
        ASSERT_EQ(vertices.size(), 3U);
        for (std::size_t i = 0; i < 3; ++i) {
            const double u = 2 * static_cast<double>(kData[9 + 2 * i]), v = 3 * static_cast<double>(kData[10 + 2 * i]);
            EXPECT_NEAR(vertices[i].texture.x, std::cos(angle) * u + std::sin(angle) * v + 1.25, 1e-5);
            EXPECT_NEAR(1 - vertices[i].texture.y, -std::sin(angle) * u + std::cos(angle) * v - 0.1, 1e-5);
        }
    }
    std::ofstream(folder_ / "m.mtl") << "newmtl m\nmap_Kd -s 4 2 1 -o 0.5 0.25 0 a.png\n";
    const auto of_obj =
        read("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n", "m.obj");
    ASSERT_TRUE(of_obj) << of_obj.error().message;
    const std::vector<MeshVertex>& vertices = of_obj->geometry.at(0).mesh->vertices;
    EXPECT_EQ(vertices.at(0).texture, glm::vec2(0.5F, 0.25F));
    EXPECT_EQ(vertices.at(1).texture, glm::vec2(4.5F, 0.25F));
    EXPECT_EQ(vertices.at(2).texture, glm::vec2(0.5F, 2.25F));
}

TEST_F(ModelFile, TheColourTextureMayUseTheSecondSetOfCoordinates) {
    ASSERT_TRUE(write_png(folder_ / "a.png", Image<Rgba8>(2, 2, Rgba8{255, 0, 0, 255}).view()).ok());
    std::string text = gltf(R"({"mesh": 0})", R"(, "materials": [{"pbrMetallicRoughness": {"baseColorTexture":
        {"index": 0, "texCoord": 1}}}], "textures": [{"source": 0}], "images": [{"uri": "a.png"}])");
    const std::string first = R"("TEXCOORD_0": 1)";
    // The first set has the positions' x and y.
    text.replace(text.find(first), first.size(), R"("TEXCOORD_0": 2, "TEXCOORD_1": 1)");
    text.insert(text.find(R"("type": "VEC2"})") + 15,
                R"(, {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC2"})");
    text.insert(text.find(R"("byteLength": 24})") + 17, R"(, {"buffer": 0, "byteOffset": 0, "byteLength": 24})");
    const auto scene = read(text);
    ASSERT_TRUE(scene) << scene.error().message;
    const std::vector<MeshVertex>& vertices = scene->geometry.at(0).mesh->vertices;
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(vertices.at(i).texture, glm::vec2(kData[9 + 2 * i], 1 - kData[10 + 2 * i]));
    }
}

TEST_F(ModelFile, MaterialsOfObjThatAreMissingAreNamed) {
    const std::string faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const auto warnings_of = [&](const std::string& text) {
        const auto scene = read(text, "hall.obj");
        EXPECT_TRUE(scene) << scene.error().message;
        return scene ? scene->warnings : std::vector<std::string>{};
    };
    std::ofstream(folder_ / "a.mtl") << "newmtl Red shiny metal\nKd 1 0 0\n";
    EXPECT_THAT(warnings_of("mtllib a.mtl\n" + faces + "usemtl Red shiny metal \r\nf 1 2 3\nusemtl None\nf 3 2 1\n"),
                IsEmpty());
    EXPECT_THAT(warnings_of("mtllib gone.mtl\n" + faces + "usemtl x\nf 1 2 3\n"),
                ElementsAre(HasSubstr("hall.obj: the material library gone.mtl does not exist")));
    EXPECT_THAT(warnings_of("mtllib a.mtl\n" + faces + "usemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\n"),
                ElementsAre(HasSubstr("hall.obj: no material library defines b and 1 more; drawn grey")));
    EXPECT_THAT(warnings_of(faces + "deg 1 1\nsurf 0 1 0 1 1 2 3 3\nend\nf 1 2 3\n"),
                ElementsAre(HasSubstr("free-form curves and surfaces are ignored")));
}

TEST_F(ModelFile, OtherEncodingsAndEditionsAreRefusedByName) {
    const auto utf16 = read(std::string("\xff\xfev\0 \0", 6), "hall.obj");
    ASSERT_FALSE(utf16);
    EXPECT_THAT(utf16.error().message, HasSubstr("hall.obj: is UTF-16 text; save it as UTF-8"));
    std::string text = gltf(R"({"mesh": 0})", kMaterial);
    text.replace(text.find("2.0"), 3, "1.0");
    const auto first = read(text);
    ASSERT_FALSE(first);
    EXPECT_THAT(first.error().message, HasSubstr("hall.gltf: is of glTF 1; convert it to glTF 2.0"));
}

// Highlights of metals have the mean colour of what multiplies their base colour; a rough white metal would else be
// white under each light, whatever its texture.
TEST_F(ModelFile, HighlightsOfMetalsHaveTheColourOfTheirTexture) {
    ASSERT_TRUE(write_png(folder_ / "a.png", Image<Rgba8>(2, 2, Rgba8{255, 0, 0, 255}).view()).ok());
    // Roughness and metallic are those of the texture: 0.2 and 1.
    ASSERT_TRUE(write_png(folder_ / "mr.png", Image<Rgba8>(2, 2, Rgba8{0, 51, 255, 255}).view()).ok());
    const auto scene = read(gltf(R"({"mesh": 0})", R"(, "materials": [{"pbrMetallicRoughness": {"baseColorTexture":
        {"index": 0}, "metallicRoughnessTexture": {"index": 1}}}], "textures": [{"source": 0}, {"source": 1}],
        "images": [{"uri": "a.png"}, {"uri": "mr.png"}])"));
    ASSERT_TRUE(scene) << scene.error().message;
    const Material& metal = scene->geometry.at(0).material;
    EXPECT_EQ(metal.specular, glm::vec3(1, 0, 0));
    EXPECT_FLOAT_EQ(metal.shininess, 1);
    std::string text = gltf(R"({"mesh": 0})", R"(, "materials": [{}])");
    const std::string place = R"("TEXCOORD_0": 1)";
    text.replace(text.find(place), place.size(), R"("COLOR_0": 0)");  // the mean of the positions: 1/3, 1/3, 0
    const auto coloured = read(text);
    ASSERT_TRUE(coloured) << coloured.error().message;
    EXPECT_NEAR(coloured->geometry.at(0).material.specular.g, 1.0 / 3, 1e-6);
    EXPECT_FLOAT_EQ(coloured->geometry.at(0).material.specular.b, 0);
}

TEST_F(ModelFile, NormalTexturesWithOtherCoordinatesAreNamed) {
    ASSERT_TRUE(write_png(folder_ / "a.png", Image<Rgba8>(2, 2, Rgba8{128, 128, 255, 255}).view()).ok());
    const auto with = [&](const std::string& colours) {
        return read(gltf(R"({"mesh": 0})", R"(, "materials": [{"name": "wall", "pbrMetallicRoughness": {)" + colours +
                                               R"(}, "normalTexture": {"index": 0, "extensions":
        {"KHR_texture_transform": {"scale": [2, 2]}}}}], "textures": [{"source": 0}], "images": [{"uri": "a.png"}],
        "extensionsUsed": ["KHR_texture_transform"])"));
    };
    const auto alone = with("");
    ASSERT_TRUE(alone) << alone.error().message;
    EXPECT_THAT(alone->warnings, IsEmpty());
    EXPECT_TRUE(alone->geometry.at(0).material.normals);
    EXPECT_EQ(alone->geometry.at(0).mesh->vertices.at(1).texture, glm::vec2(2, -1));
    const auto both = with(R"("baseColorTexture": {"index": 0})");
    ASSERT_TRUE(both) << both.error().message;
    EXPECT_THAT(both->warnings,
                ElementsAre(HasSubstr("material \"wall\": the normal texture has other coordinates than the color")));
    EXPECT_FALSE(both->geometry.at(0).material.normals);
}

TEST_F(ModelFile, UnlitMaterialsHaveTheirBaseColour) {
    const auto scene = read(gltf(R"({"mesh": 0})", R"(, "materials": [{"pbrMetallicRoughness": {"baseColorFactor":
        [0.5, 1, 0.25, 1]}, "extensions": {"KHR_materials_unlit": {}}}], "extensionsUsed": ["KHR_materials_unlit"])"));
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_FALSE(scene->geometry.at(0).material.lit);
    EXPECT_EQ(scene->geometry.at(0).material.diffuse, glm::vec3(0.5F, 1, 0.25F));
}

TEST_F(ModelFile, GaussianSplatsArePointsOfTheirColour) {
    const auto scene = read(
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
        "property float z\nproperty float f_dc_0\nproperty float f_dc_1\nproperty float f_dc_2\n"
        "property float opacity\nend_header\n0 0 0 1.7724539 0 -1.7724539 9\n",
        "splat.ply");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->geometry.at(0).mesh->topology, Topology::kPoints);
    const glm::vec4 colour = scene->geometry.at(0).mesh->vertices.at(0).colour;
    EXPECT_NEAR(colour.r, 1, 1e-5);
    EXPECT_NEAR(colour.g, 0.21404, 1e-4);  // sRGB 0.5
    EXPECT_NEAR(colour.b, 0, 1e-5);
}

TEST_F(ModelFile, ObjectsAloneMakeAScene) {
    const auto scene = read(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"extras": {"RaySpace": {"url": "a.rso"}}}]})");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->objects.size(), 1U);
}

TEST_F(ModelFile, FaultyFilesAreRefused) {
    EXPECT_FALSE(read("", "empty.gltf"));
    EXPECT_FALSE(read("{\"scenes\": [{\"nodes\": [0]}], \"nodes\": [{\"children\": [0]}]}", "ring.gltf"));
    EXPECT_FALSE(read("{\"scenes\": [{\"nodes\": [7]}]}", "gone.gltf"));
    EXPECT_FALSE(read("not a model", "hall.obj"));
    EXPECT_FALSE(read_model(folder_ / "nowhere.gltf"));
}

TEST_F(ModelFile, FacesOfTwoCornersAreLines) {
    const auto scene = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 1 2 3\n", "a.obj");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->geometry.size(), 2U);
    const std::set<Topology> kinds = {scene->geometry[0].mesh->topology, scene->geometry[1].mesh->topology};
    EXPECT_EQ(kinds, (std::set<Topology>{Topology::kLines, Topology::kTriangles}));
}

TEST_F(ModelFile, AnObjIsRead) {
    // The second has indented statements, as some exporters write them, which Assimp does not recognise.
    for (const char* materials : {"newmtl red\nKd 1 0 0\nKs 0.5 0.5 0.5\nNs 64\nillum 2\n",
                                  "\tnewmtl red\r\n\t\tKd 1 0 0\r\n \r\n  Ks 0.5 0.5 0.5\r\n\t\tNs 64\r\n  illum 2"}) {
        std::ofstream(folder_ / "hall.mtl") << materials;
        const auto scene = read("mtllib hall.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n", "hall.obj");
        ASSERT_TRUE(scene) << scene.error().message;
        ASSERT_EQ(scene->geometry.size(), 1U);
        EXPECT_EQ(scene->geometry[0].material.diffuse, glm::vec3(1, 0, 0));
        EXPECT_FLOAT_EQ(scene->geometry[0].material.shininess, 0.5F);
    }
}

}  // namespace
}  // namespace rs::compositor
