// Exported scenes (compositor/scene/export), read back by the project's own reader and by Assimp.

#include "compositor/scene/export/gltf_file.hpp"

#include "compositor/scene/reader/scene_file.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/file/file_output.hpp"
#include "tests/support/temporary_folder.hpp"

#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <tuple>

namespace rs::compositor {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::string url_of_name(const std::filesystem::path& file) {
    return url_of_path(file.filename());
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-5) {
    EXPECT_NEAR(glm::distance(a, b), 0, tolerance) << a.x << " " << a.y << " " << a.z;
}

// Corners of all triangles in scene coordinates, sorted.
std::vector<std::array<double, 3>> corners_of(const Scene& scene) {
    std::vector<std::array<double, 3>> corners;
    for (const GeometryNode& node : scene.geometry) {
        for (const std::uint32_t i : node.mesh->indices) {
            const glm::dvec4 p = node.world_from_node * glm::dvec4(node.mesh->vertices[i].position, 1);
            corners.push_back({std::round(p.x * 1e4), std::round(p.y * 1e4), std::round(p.z * 1e4)});
        }
    }
    std::ranges::sort(corners);
    return corners;
}

class GltfFileTest : public testing::Test {
protected:
    GltfFileTest() { scene_.lights.clear(); }

    // Exports the scene and reads it.
    Scene round_trip() {
        Result<GltfFile> file = export_gltf(scene_, url_of_name);
        EXPECT_TRUE(file) << file.error().message;
        warnings_ = file->warnings;
        EXPECT_TRUE(write_file(folder_ / "scene.glb", file->bytes).ok());
        Result<Scene> read = read_scene(folder_ / "scene.glb");
        EXPECT_TRUE(read) << read.error().message;
        EXPECT_THAT(read->warnings, IsEmpty());
        return std::move(*read);
    }
    GeometryNode& add_box(const glm::dvec3& size, const glm::dvec3& place) {
        GeometryNode& node = scene_.geometry.emplace_back();
        node.mesh = std::make_shared<const Mesh>(box_mesh(size));
        node.world_from_node[3] = glm::dvec4(place, 1);
        return node;
    }

    test::TemporaryFolder folder_;
    Scene scene_;
    std::vector<std::string> warnings_;
};

TEST_F(GltfFileTest, TrianglesComeBackAlsoFromMirroredAndShearedNodes) {
    add_box({1, 2, 3}, {4, 5, 6});
    add_box({1, 1, 1}, {0, 0, 0}).world_from_node[0].x = -2;
    add_box({1, 1, 1}, {-3, 0, 0}).world_from_node[1].x = 0.7;
    const Scene read = round_trip();
    EXPECT_EQ(corners_of(read), corners_of(scene_));
    EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(GltfFileTest, MaterialsAndTexturesComeBack) {
    auto texture = std::make_shared<SceneTexture>();
    texture->image = Image<Rgba8>(2, 1);
    texture->image(0, 0) = {255, 0, 0, 255};
    texture->image(1, 0) = {0, 0, 255, 255};
    texture->repeat_s = false;
    texture->modulates = true;
    scene_.geometry.reserve(3);  // so that the first node stays where it is
    GeometryNode& textured = add_box({1, 1, 1}, {0, 0, 0});
    textured.material.diffuse = glm::vec3(0.5F, 0.25F, 0.75F);
    textured.material.emissive = glm::vec3(0.1F, 0.2F, 0.3F);
    textured.material.texture = texture;
    textured.material.texture_transform[2] = glm::vec3(0.25F, 0.5F, 1);
    add_box({1, 1, 1}, {2, 0, 0}).material.surface =
        SurfaceProperties{.kind = rs::SurfaceKind::metal, .colour = glm::vec3(0.9F, 0.6F, 0.2F), .roughness = 0.25F};
    add_box({1, 1, 1}, {4, 0, 0}).material.opacity = 0.5F;
    const Scene read = round_trip();
    ASSERT_EQ(read.geometry.size(), 3U);
    const Material& first = read.geometry[0].material;
    expect_near(first.diffuse, textured.material.diffuse);
    expect_near(first.surface->emission, textured.material.emissive);
    ASSERT_NE(first.texture, nullptr);
    EXPECT_EQ(first.texture->image, texture->image);
    EXPECT_FALSE(first.texture->repeat_s);
    EXPECT_TRUE(first.texture->repeat_t);
    const MeshVertex& vertex = read.geometry[0].mesh->vertices[read.geometry[0].mesh->indices[0]];
    const Mesh& source = *scene_.geometry[0].mesh;
    expect_near({vertex.texture, 0}, {source.vertices[source.indices[0]].texture + glm::vec2(0.25F, 0.5F), 0});
    const SurfaceProperties& metal = *read.geometry[1].material.surface;
    EXPECT_EQ(metal.kind, rs::SurfaceKind::metal);
    expect_near(metal.colour, {0.9, 0.6, 0.2});
    EXPECT_NEAR(metal.roughness, 0.25, 1e-6);
    EXPECT_NEAR(read.geometry[2].material.opacity, 0.5, 1e-6);
}

TEST_F(GltfFileTest, LightsComeBack) {
    Light sun = directional_light({0.6, -0.8, 0}, glm::vec3(2, 1, 0.5F));
    sun.ambient = glm::vec3(0.2F, 0.1F, 0.3F);
    scene_.lights.push_back(sun);
    Light spot = point_light({1, 2, 3}, glm::vec3(4));
    spot.kind = LightKind::kSpot;
    spot.towards = glm::dvec3(0, 0, -1);
    spot.cut_off_rad = 0.5;
    spot.beam_width_rad = 0.25;
    spot.radius = 7;
    scene_.lights.push_back(spot);
    const Scene read = round_trip();
    ASSERT_EQ(read.lights.size(), 2U);
    expect_near(read.lights[0].towards, sun.towards);
    expect_near(read.lights[0].ambient, sun.ambient);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(read.lights[i].kind, scene_.lights[i].kind);
        for (const glm::dvec3& place : {glm::dvec3(1, 2, 2), glm::dvec3(1.2, 2, -1)}) {
            expect_near(irradiance_at(read.lights[i], place), irradiance_at(scene_.lights[i], place), 1e-4);
        }
    }
    EXPECT_NEAR(read.lights[1].cut_off_rad, 0.5, 1e-6);
    EXPECT_NEAR(read.lights[1].beam_width_rad, 0.25, 1e-6);
    EXPECT_NEAR(read.lights[1].radius, 7, 1e-6);
    EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(GltfFileTest, ObjectsRoomsAndViewpointsComeBack) {
    std::ofstream(folder_ / "a vase.rso") << "object";
    scene_.rooms.push_back({"hall", {glm::dvec3(-5, 0, -5), glm::dvec3(5, 3, 5)}});
    NodeTransform transform;
    transform.translation = {1, 2, 3};
    transform.angle_rad = 0.7;
    transform.scale = 0.3;
    transform.mirrored = true;
    RaySpaceNode& vase = scene_.objects.emplace_back();
    vase.file = folder_ / "a vase.rso";
    vase.chain = {transform};
    vase.standing = false;
    vase.room = 0;
    Viewpoint viewpoint{.description = "from the door", .field_of_view_rad = 0.6};
    viewpoint.world_from_camera[3] = glm::dvec4(0, 1.6, 4, 1);
    scene_.viewpoints = {viewpoint, viewpoint};
    const Scene read = round_trip();
    ASSERT_EQ(read.objects.size(), 1U);
    EXPECT_EQ(read.objects[0].file, folder_ / "a vase.rso");
    EXPECT_FALSE(read.objects[0].standing);
    EXPECT_EQ(read.objects[0].room, 0U);
    const Similarity expected = world_from_node(scene_.objects[0].chain);
    const Similarity placed = world_from_node(read.objects[0].chain);
    for (const glm::dvec3& p : {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 2)}) {
        expect_near(placed.point(p), expected.point(p));
    }
    ASSERT_EQ(read.rooms.size(), 1U);
    EXPECT_EQ(read.rooms[0].description, "hall");
    expect_near(read.rooms[0].box.highest, {5, 3, 5});
    ASSERT_EQ(read.viewpoints.size(), 2U) << "of the same name";
    EXPECT_EQ(read.viewpoints[0].description, "from the door");
    EXPECT_NEAR(read.viewpoints[0].field_of_view_rad, 0.6, 1e-9);
    expect_near(glm::dvec3(read.viewpoints[0].world_from_camera[3]), {0, 1.6, 4});
}

TEST_F(GltfFileTest, AssimpReadsTheSameTriangles) {
    add_box({1, 2, 3}, {4, 5, 6}).material.diffuse = glm::vec3(1, 0.5F, 0);
    add_box({2, 2, 2}, {0, 0, 0});
    const GltfFile file = export_gltf(scene_, url_of_name).value();
    Assimp::Importer importer;
    const aiScene* const read = importer.ReadFileFromMemory(file.bytes.data(), file.bytes.size(), 0, "glb");
    ASSERT_NE(read, nullptr) << importer.GetErrorString();
    ASSERT_EQ(read->mNumMeshes, 2U);
    EXPECT_EQ(read->mMeshes[0]->mNumFaces, 12U);
    EXPECT_TRUE(read->mMeshes[0]->HasNormals());
    aiColor4D colour;
    ASSERT_EQ(read->mMaterials[read->mMeshes[0]->mMaterialIndex]->Get(AI_MATKEY_BASE_COLOR, colour), AI_SUCCESS);
    EXPECT_NEAR(colour.g, 0.5, 1e-6);
}

TEST_F(GltfFileTest, NothingIsLostInSilence) {
    add_box({1, 1, 1}, {0, 0, 0});
    scene_.floor = Floor{};
    scene_.fog = Fog{};
    scene_.background.ground = {glm::vec3(0.1F)};
    scene_.navigation.headlight = true;
    scene_.camera = CameraPath{};
    scene_.lights.push_back(rectangle_light({0, 2, 0}, {1, 0, 0}, {0, 0, 1}, glm::vec3(1)));
    Light lamp = point_light({0, 2, 0}, glm::vec3(1));
    lamp.name = "lamp";
    lamp.attenuation = {1, 0, 0};
    lamp.everywhere = false;
    scene_.lights.push_back(lamp);
    const Scene read = round_trip();
    for (const char* part : {"floor: ", "fog: ", "background: ", "headlight: ", "camera animation: ", "lights: some",
                             "light: becomes a spot", "lamp: its attenuation"}) {
        EXPECT_THAT(warnings_, Contains(HasSubstr(part)));
    }
    EXPECT_EQ(read.geometry.size(), 2U) << "the floor is a surface";
    const BoundingBox bounds = bounds_of(read);
    EXPECT_NEAR(bounds.highest.x, Floor{}.radius, 0.1);
}

}  // namespace
}  // namespace rs::compositor
