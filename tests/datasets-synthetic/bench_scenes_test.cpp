// Rooms to measure with: as many triangles as they say, the same every time, and lights that can be read.

#include "rayspace/light/luminaire.hpp"
#include "tests/bench/scenes/cabin.hpp"
#include "tests/bench/scenes/hall.hpp"
#include "tests/bench/scenes/light_list.hpp"
#include "tests/bench/scenes/model_file.hpp"
#include "tests/datasets-synthetic/digest.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

namespace rs::synthetic {
namespace {

std::uint64_t digest_of(const Model& model) {
    Digest sum;
    for (const ModelGroup& group : model.groups) {
        for (const capture::Mesh& mesh : group.meshes) {
            sum.add(mesh.positions);
            sum.add(mesh.normals);
            sum.add(mesh.triangles);
        }
    }
    for (const ModelNode& node : model.nodes) sum.add_bytes(&node.world_from_group, sizeof node.world_from_group);
    return sum.value();
}

TEST(MeasuringRooms, HaveTheirTrianglesExactlyAndTheSameBitsEveryTime) {
    EXPECT_EQ(triangle_count(make_hall()), 66'450);
    EXPECT_EQ(triangle_count(make_great_hall()), 150'220);
    EXPECT_EQ(triangle_count(make_cabin()), 2'800'000);
    EXPECT_EQ(digest_of(make_hall()), digest_of(make_hall()));
    EXPECT_EQ(digest_of(make_cabin()), digest_of(make_cabin()));
}

// Every triangle has an area, is wound as its normals say, and stands in the room.
TEST(MeasuringRooms, AreSoundMeshes) {
    for (const Model& model : {make_hall(), make_great_hall(), make_cabin()}) {
        int flat = 0, turned = 0, all = 0;
        for (const ModelGroup& group : model.groups) {
            for (const capture::Mesh& mesh : group.meshes) {
                ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
                ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
                ASSERT_LT(static_cast<std::size_t>(mesh.material), model.materials.size());
                for (const glm::uvec3& t : mesh.triangles) {
                    const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
                    const glm::vec3 cross = glm::cross(b - a, c - a);
                    ++all;
                    flat += !(glm::length(cross) > 1e-12F);
                    turned += glm::dot(cross, mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z]) < 0.0F;
                }
            }
        }
        EXPECT_EQ(flat, 0) << model.name;
        EXPECT_LT(turned, all / 200) << model.name;
        for (const ModelNode& node : model.nodes) {
            for (const capture::Mesh& mesh : model.groups[node.group].meshes) {
                for (const glm::vec3& p : mesh.positions) {
                    const glm::vec3 there(node.world_from_group * glm::vec4(p, 1.0F));
                    ASSERT_TRUE(there.x > -1.0F && there.x < 48.0F && there.y > -0.2F && there.y < 9.0F &&
                                std::abs(there.z) < 6.0F)
                        << model.name << " " << mesh.name;
                }
            }
        }
    }
}

TEST(MeasuringRooms, TheCabinIsLitBySixAreasFortyTwoSpotsAndASun) {
    const Model cabin = make_cabin();
    const nlohmann::json list = nlohmann::json::parse(cabin.lights);
    std::map<std::string, int> kinds;
    for (const auto& light : list["lights"]) {
        ++kinds[light["kind"]];
        if (light.contains("file")) {
            EXPECT_TRUE(cabin.luminaires.contains(light["file"]));
        }
    }
    EXPECT_EQ(kinds["rectangle"], kCabinAreas);
    EXPECT_EQ(kinds["luminaire"], kCabinSpots);
    EXPECT_EQ(kinds["directional"], 1);
}

TEST(MeasuringRooms, BeamsHaveTheirLumensAndTheirWidth) {
    const auto read = parse_ies(beam_ies("beam", 110, 14), "beam");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_NEAR(read->web.lumens(), 110, 0.5);
    EXPECT_NEAR(read->web.candela({std::sin(radians(14)), -std::cos(radians(14)), 0}) / read->web.candela({0, -1, 0}),
                0.5 * std::cos(radians(14)), 0.01);
}

TEST(MeasuringRooms, AreWrittenWithWhatTheyName) {
    const test::TemporaryFolder folder;
    ASSERT_TRUE(write_model(make_hall(), folder / "hall", "hall"));
    const nlohmann::json gltf = nlohmann::json::parse(std::ifstream(folder / "hall" / "hall.gltf"));
    EXPECT_EQ(gltf["buffers"][0]["byteLength"], std::filesystem::file_size(folder / "hall" / "hall.bin"));
    std::int64_t triangles = 0;
    for (const auto& node : gltf["nodes"]) {
        if (!node.contains("mesh")) continue;
        for (const auto& primitive : gltf["meshes"][node["mesh"].get<std::size_t>()]["primitives"]) {
            triangles += gltf["accessors"][primitive["indices"].get<std::size_t>()]["count"].get<std::int64_t>() / 3;
        }
    }
    EXPECT_EQ(triangles, kHallTriangles);
    for (const char* file : {"lights.json", "marble.png", "dark.png"}) {
        EXPECT_TRUE(std::filesystem::exists(folder / "hall" / file)) << file;
    }
}

}  // namespace
}  // namespace rs::synthetic
