// PLY files, written here byte by byte, and every way in which one can be wrong.

#include "capture/tracer/scene/mesh_file.hpp"
#include "tests/capture/tracer/mesh_files.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

namespace rs::capture::test {
namespace {

using rs::test::TemporaryFolder;
using testing::HasSubstr;

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

constexpr const char* kPlyVertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
constexpr const char* kPlyFaces = "element face 1\nproperty list uchar int vertex_indices\n";
constexpr const char* kPlySquare = "0 0 0\n2 0 0\n2 2 0\n0 2 0\n";

std::string ascii_ply(const std::string& elements, const std::string& body) {
    return "ply\nformat ascii 1.0\n" + elements + "end_header\n" + body;
}

// Signed area about Z, with which the square above has 4.
float area_of(const Result<Scene>& scene) {
    float area = 0;
    for (const Mesh& mesh : scene->meshes) {
        for (const glm::uvec3& t : mesh.triangles) {
            const glm::vec3 corner = mesh.positions[t.x];
            area += 0.5F * glm::cross(mesh.positions[t.y] - corner, mesh.positions[t.z] - corner).z;
        }
    }
    return area;
}

TEST(PlyFile, ElementsMustBeThoseOfAMesh) {
    const TemporaryFolder folder;
    const auto error = [&](const std::string& elements, const std::string& body) {
        write_text(folder / "a.ply", ascii_ply(elements, body));
        return error_of(folder / "a.ply");
    };
    const std::string vertices = kPlyVertices;
    const std::string faces = kPlyFaces;
    const std::string square = kPlySquare;
    const std::string face = "4 0 1 2 3\n";
    EXPECT_EQ(error(vertices + faces, square + face), "read without an error");
    EXPECT_THAT(error(vertices + vertices + faces, square + square + face),
                HasSubstr("two elements are named \"vertex\""));
    EXPECT_THAT(error(vertices + faces + faces, square + face + face), HasSubstr("two elements are named \"face\""));
    EXPECT_THAT(error(faces + vertices, face + square), HasSubstr("element face comes before element vertex"));
    EXPECT_THAT(error("element vertex 4\nproperty float x\nproperty float z\n" + faces, "0 0\n2 0\n2 2\n0 2\n" + face),
                HasSubstr("vertices have no y"));
    EXPECT_THAT(error("element vertex 4\nproperty list uchar float x\nproperty float y\nproperty float z\n" + faces,
                      "0 0 0\n0 0 0\n0 2 0\n0 2 0\n" + face),
                HasSubstr("x is a list; it must be one number"));
    EXPECT_THAT(error(vertices + "property float x\n" + faces, square + face), HasSubstr("two properties \"x\""));
    const std::string needed = "needs one list of whole numbers named vertex_indices";
    EXPECT_THAT(error(vertices + "element face 1\nproperty int vertex_indices\n", square + "1\n"), HasSubstr(needed));
    EXPECT_THAT(error(vertices + "element face 1\nproperty list uchar float vertex_index\n", square + face),
                HasSubstr(needed));
    EXPECT_THAT(error(vertices + "element face 1\nproperty list uchar int corners\n", square + face),
                HasSubstr(needed));
    EXPECT_THAT(error(vertices + faces + "element tristrips 2\nproperty list int int vertex_indices\n",
                      square + face + "3 0 1 2\n3 0 2 3\n"),
                HasSubstr("both faces and tristrips"));
    EXPECT_THAT(error(vertices + faces, square + "2 0 1\n"), HasSubstr("has no faces"));
    EXPECT_THAT(error(vertices + "element face 1\nproperty list char char vertex_indices\n", square + "300 0 1 2\n"),
                HasSubstr("no valid length"));
}

TEST(PlyFile, StripsBecomeTrianglesAndBeginAnewAtMinusOne) {
    const TemporaryFolder folder;
    const std::string elements =
        std::string(kPlyVertices) + "element tristrips 1\nproperty list int int vertex_indices\n";
    write_text(folder / "a.ply", ascii_ply(elements, std::string(kPlySquare) + "4 0 1 3 2\n"));
    const Result<Scene> one = read_mesh_file(folder / "a.ply");
    ASSERT_TRUE(one) << one.error().message;
    EXPECT_EQ(one->meshes[0].triangles.size(), 2U);
    EXPECT_NEAR(area_of(one), 4.0F, 1e-5F) << "both triangles face the same way";
    write_text(folder / "a.ply", ascii_ply(elements, std::string(kPlySquare) + "7 0 1 2 -1 0 2 3\n"));
    const Result<Scene> two = read_mesh_file(folder / "a.ply");
    ASSERT_TRUE(two) << two.error().message;
    EXPECT_EQ(two->meshes[0].triangles.size(), 2U);
    EXPECT_NEAR(area_of(two), 4.0F, 1e-5F);
    write_text(folder / "a.ply", ascii_ply(elements, std::string(kPlySquare) + "4 0 1 -2 2\n"));
    EXPECT_THAT(error_of(folder / "a.ply"), HasSubstr("names a vertex that does not exist"));
    write_text(folder / "a.ply",
               ascii_ply(std::string(kPlyVertices) + kPlyFaces, std::string(kPlySquare) + "4 0 1 2 -1\n"));
    EXPECT_THAT(error_of(folder / "a.ply"), HasSubstr("names a vertex that does not exist")) << "no strip";
}

TEST(PlyFile, KeepsNormals) {
    const TemporaryFolder folder;
    write_text(folder / "a.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
               "property float nx\nproperty float ny\nproperty float nz\n"
               "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
               "0 0 0 0 0.6 0.8\n2 0 0 0 0.6 0.8\n2 2 0 0 0.6 0.8\n3 0 1 2\n");
    const Result<Scene> scene = read_mesh_file(folder / "a.ply");
    ASSERT_TRUE(scene) << scene.error().message;
    for (const glm::vec3& normal : scene->meshes[0].normals) {
        EXPECT_LT(glm::distance(normal, glm::vec3(0, 0.6F, 0.8F)), 1e-6F);
    }
}

TEST(PlyFile, TheFirstMaterialIsTheMeshs) {
    const TemporaryFolder folder;
    const std::string begin =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\n";
    const std::string body = "end_header\n0 0 0\n2 0 0\n2 2 0\n3 0 1 2\n";
    const std::string colour =
        "property uchar diffuse_red\nproperty uchar diffuse_green\nproperty float diffuse_blue\n";
    write_text(folder / "a.ply", begin + "element material 2\n" + colour + body + "255 0 0.5\n9 9 9\n");
    const Result<Scene> scene = read_mesh_file(folder / "a.ply");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->materials.size(), 1U);
    EXPECT_EQ(scene->materials[0].colour, glm::vec3(1, 0, 0.5F));
    // As many as there may be: none takes memory but the first.
    std::string rows;
    for (int i = 0; i < 200000; ++i) rows += "1 2 3\n";
    write_text(folder / "many.ply", begin + "element material 200000\n" + colour + body + rows);
    const Result<Scene> many = read_mesh_file(folder / "many.ply");
    ASSERT_TRUE(many) << many.error().message;
    EXPECT_EQ(many->materials.size(), 1U);
    // Before, an opacity without a shininess was refused.
    write_text(folder / "clear.ply", begin + "element material 1\nproperty float opacity\n" + body + "0.25\n");
    const Result<Scene> clear = read_mesh_file(folder / "clear.ply");
    EXPECT_TRUE(clear) << clear.error().message;
}

TEST(PlyFile, CommentsAndForeignElementsChangeNothing) {
    const TemporaryFolder folder;
    // A first coordinate whose first byte is a line feed, an element of another kind, and two lines in one.
    float x = 0;
    const std::uint32_t bits = 0x4000000A;  // a little more than 2
    std::memcpy(&x, &bits, sizeof x);
    std::string body;
    const auto append = [&](auto value) { body.append(reinterpret_cast<const char*>(&value), sizeof value); };
    for (const float v : {x, 0.0F, 0.0F, 0.0F, 2.0F, 0.0F, 0.0F, 0.0F, 0.0F}) append(v);
    const std::string vertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    for (const bool foreign : {false, true}) {
        std::string rest;
        if (foreign) rest.append("\1\2", 2);
        rest += '\3';
        for (const std::int32_t i : {0, 1, 2}) rest.append(reinterpret_cast<const char*>(&i), sizeof i);
        write_text(folder / "a.ply", "ply\nformat binary_little_endian 1.0\n" + vertices +
                                         (foreign ? "element scan 2\nproperty uchar row\n" : "") + kPlyFaces +
                                         "end_header\n" + body + rest);
        const Result<Scene> scene = read_mesh_file(folder / "a.ply");
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_NEAR(area_of(scene), 2.0F, 1e-4F) << foreign;
    }
    write_text(folder / "a.ply", ascii_ply(std::string("comment vertex 1\n") + kPlyVertices + kPlyFaces,
                                           "0 0 0 2 0 0\n2 2 0\n0 2 0 4 0 1\n2 3\n3 0 1 900000000\n"));
    const Result<Scene> scene = read_mesh_file(folder / "a.ply");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_NEAR(area_of(scene), 4.0F, 1e-5F);
}

TEST(PlyFile, KeepsTextureCoordinatesOfVerticesAndFaces) {
    const TemporaryFolder folder;
    write_text(folder / "a.ply", ascii_ply("element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                                           "property double s\nproperty double t\n" +
                                               std::string(kPlyFaces),
                                           "0 0 0 0 0\n2 0 0 1 0\n0 2 0 0 1\n3 0 1 2\n"));
    write_text(folder / "b.ply", ascii_ply("element vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
                                               std::string(kPlyFaces) + "property list uchar float texcoord\n",
                                           "0 0 0\n2 0 0\n0 2 0\n3 0 1 2 6 0 0 1 0 0 1\n"));
    for (const char* name : {"a.ply", "b.ply"}) {
        const Result<Scene> scene = read_mesh_file(folder / name);
        ASSERT_TRUE(scene) << scene.error().message;
        const Mesh& mesh = scene->meshes[0];
        ASSERT_EQ(mesh.uvs.size(), 3U) << name;
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(mesh.uvs[i].x, mesh.positions[i].x / 2) << name;
            EXPECT_EQ(mesh.uvs[i].y, mesh.positions[i].y / 2) << name;
        }
    }
    // Eight numbers for three vertices would make Assimp read beyond the face.
    write_text(folder / "b.ply", ascii_ply("element vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
                                               std::string(kPlyFaces) + "property list uchar float texcoord\n",
                                           "0 0 0\n2 0 0\n0 2 0\n3 0 1 2 8 0 0 1 0 0 1 0 0\n"));
    const Result<Scene> scene = read_mesh_file(folder / "b.ply");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(scene->meshes[0].uvs.empty());
}

}  // namespace
}  // namespace rs::capture::test
