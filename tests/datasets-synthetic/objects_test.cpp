// Invariants of all procedural objects.

#include "datasets-synthetic/objects.hpp"
#include "tests/datasets-synthetic/digest.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace rs::synthetic {
namespace {

using capture::Mesh;
using capture::Scene;
using glm::vec3;

constexpr std::uint64_t kSeed = 7;

bool is_finite(vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

vec3 face_cross(const Mesh& mesh, glm::uvec3 t) {
    const vec3 a = mesh.positions[t.x];
    return glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
}

class EveryObject : public testing::TestWithParam<std::string> {
protected:
    // Generated once per process.
    static const Scene& scene() {
        static std::map<std::string, Scene> made;
        const std::string& name = GetParam();
        if (const auto it = made.find(name); it != made.end()) return it->second;
        Result<Scene> result = generate(name, nullptr, kSeed);
        EXPECT_TRUE(result.ok()) << result.error().message;
        return made.emplace(name, std::move(result).value()).first->second;
    }
};

TEST_P(EveryObject, IsNormalised) {
    vec3 low{1e9F};
    vec3 high{-1e9F};
    float radius = 0.0F;
    for (const Mesh& mesh : scene().meshes) {
        for (const vec3& p : mesh.positions) {
            ASSERT_TRUE(is_finite(p)) << mesh.name;
            low = glm::min(low, p);
            high = glm::max(high, p);
            radius = std::max(radius, glm::length(p));
        }
    }
    EXPECT_NEAR(radius, 1.0F, 1e-5F);
    EXPECT_LT(glm::length(low + high), 1e-5F);
}

TEST_P(EveryObject, IndicesAreInRange) {
    ASSERT_FALSE(scene().meshes.empty());
    for (const Mesh& mesh : scene().meshes) {
        ASSERT_FALSE(mesh.triangles.empty()) << mesh.name;
        EXPECT_EQ(mesh.normals.size(), mesh.positions.size()) << mesh.name;
        EXPECT_EQ(mesh.uvs.size(), mesh.positions.size()) << mesh.name;
        ASSERT_GE(mesh.material, 0) << mesh.name;
        ASSERT_LT(mesh.material, static_cast<int>(scene().materials.size())) << mesh.name;
        for (const glm::uvec3& t : mesh.triangles) {
            ASSERT_LT(std::max({t.x, t.y, t.z}), mesh.positions.size()) << mesh.name;
        }
    }
    for (const capture::Material& material : scene().materials) {
        EXPECT_GE(material.texture, -1) << material.name;
        EXPECT_LT(material.texture, static_cast<int>(scene().textures.size())) << material.name;
    }
}

TEST_P(EveryObject, HasNoDegenerateTrianglesToSpeakOf) {
    for (const Mesh& mesh : scene().meshes) {
        std::size_t degenerate = 0;
        for (const glm::uvec3& t : mesh.triangles) degenerate += glm::length(face_cross(mesh, t)) < 1e-11F ? 1U : 0U;
        EXPECT_LE(1000 * degenerate, mesh.triangles.size()) << mesh.name;
    }
}

TEST_P(EveryObject, NormalsAreUnitAndAgreeWithFaces) {
    for (const Mesh& mesh : scene().meshes) {
        for (const vec3& n : mesh.normals) ASSERT_NEAR(glm::length(n), 1.0F, 1e-4F) << mesh.name;
        std::size_t disagree = 0;
        double sum = 0;
        for (const glm::uvec3& t : mesh.triangles) {
            const vec3 cross = face_cross(mesh, t);
            const vec3 face = cross / std::max(glm::length(cross), 1e-20F);
            float least = 1.0F;
            for (int c = 0; c < 3; ++c) least = std::min(least, glm::dot(face, mesh.normals[t[c]]));
            disagree += least < 0.3F ? 1U : 0U;
            sum += static_cast<double>(least);
        }
        EXPECT_LE(200 * disagree, mesh.triangles.size())
            << mesh.name << ": " << disagree << " of " << mesh.triangles.size();
        EXPECT_GT(sum / static_cast<double>(mesh.triangles.size()), 0.8) << mesh.name;
    }
}

TEST_P(EveryObject, PaintIsPlausible) {
    for (const capture::Texture& texture : scene().textures) {
        ASSERT_FALSE(texture.pixels.empty()) << texture.name;
        float darkest = 1.0F;
        float brightest = 0.0F;
        for (const RgbaF& p : texture.pixels.pixels()) {
            ASSERT_TRUE(p.r >= 0.0F && p.g >= 0.0F && p.b >= 0.0F) << texture.name;
            ASSERT_TRUE(p.r <= 0.9F && p.g <= 0.9F && p.b <= 0.9F) << texture.name;
            ASSERT_EQ(p.a, 1.0F) << texture.name;
            darkest = std::min(darkest, p.g);
            brightest = std::max(brightest, p.g);
        }
        EXPECT_GT(brightest, darkest + 0.05F) << texture.name << " shows nothing";
    }
    for (const capture::Material& material : scene().materials) {
        if (material.texture >= 0) continue;
        // Glass has a transmittance, everything else an albedo.
        const float most = material.kind == capture::SurfaceKind::glass ? 1.0F : 0.9F;
        for (int c = 0; c < 3; ++c) EXPECT_LE(material.colour[c], most) << material.name;
    }
}

TEST_P(EveryObject, SeedDecidesEverything) {
    const Result<Scene> again = generate(GetParam(), nlohmann::json::object(), kSeed);
    const Result<Scene> other = generate(GetParam(), nullptr, kSeed + 1);
    ASSERT_TRUE(again.ok() && other.ok());
    EXPECT_EQ(digest(*again), digest(scene()));
    EXPECT_NE(digest(*other), digest(scene()));
}

INSTANTIATE_TEST_SUITE_P(Objects, EveryObject, testing::ValuesIn(object_names()),
                         [](const testing::TestParamInfo<std::string>& object) { return object.param; });

TEST(Objects, AreAtLeastFiveAndUnique) {
    const std::vector<std::string> names = object_names();
    EXPECT_GE(names.size(), 5U);
    for (const std::string& name : names) EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
}

TEST(Objects, UnknownNameListsTheKnownOnes) {
    const Result<Scene> result = generate("teapot", nullptr, 1);
    ASSERT_FALSE(result.ok());
    EXPECT_THAT(result.error().message, testing::HasSubstr("teapot"));
    for (const std::string& name : object_names()) EXPECT_THAT(result.error().message, testing::HasSubstr(name));
}

}  // namespace
}  // namespace rs::synthetic
