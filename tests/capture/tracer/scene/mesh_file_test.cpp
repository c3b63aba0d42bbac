// OBJ files with MTL, and behaviour common to all mesh files.

#include "capture/tracer/scene/mesh_file.hpp"
#include "tests/capture/tracer/mesh_files.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace rs::capture::test {
namespace {

using rs::test::TemporaryFolder;
using testing::HasSubstr;

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

TEST(MeshFile, FacesOfTwoCornersAreLinesAndLeftOut) {
    const TemporaryFolder folder;
    write_text(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 1 2 3\n");
    const auto scene = read_mesh_file(folder / "a.obj");
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    ASSERT_EQ(scene->meshes.size(), 1U);
    EXPECT_EQ(scene->meshes[0].triangles.size(), 1U);
}

TEST(MeshFile, AGlbThatClaimsMoreThanItHoldsIsRefused) {
    const TemporaryFolder folder;
    using namespace std::string_literals;
    for (const std::string& chunk :
         {"\xFF\xFF\xFF\xFFJSON{}  "s, "\x04\0\0\0JSON{}  \x01\0\0\0BIN\0"s, "\x04\0\0\0JS"s, ""s}) {
        write_text(folder / "a.glb", "glTF\2\0\0\0\xFF\0\0\0"s + chunk);
        EXPECT_THAT(error_of(folder / "a.glb"), HasSubstr("a.glb: is a damaged .glb file")) << chunk.size();
    }
}

// Assimp would detect the format by content, which would expose all of its readers.
TEST(MeshFile, AFileIsReadAsWhatItsNameSaysOnly) {
    const TemporaryFolder folder;
    write_text(folder / "off.gltf", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    EXPECT_THAT(error_of(folder / "off.gltf"), HasSubstr("off.gltf: cannot be read as a mesh"));
}

TEST(MeshFile, MissingTextureIsNamedWithTheFileThatAsks) {
    const TemporaryFolder folder;
    write_text(folder / "a.obj", std::string("mtllib a.mtl\n") + kQuad + "usemtl p\nf 1/1 2/2 3/3\n");
    write_text(folder / "a.mtl", "newmtl p\nmap_Kd lost.png\n");
    const std::string message = error_of(folder / "a.obj");
    EXPECT_THAT(message, HasSubstr("a.obj: texture "));
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
}  // namespace rs::capture::test
