// Glass surfaces are closed with outward faces.

#include "datasets-synthetic/objects.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace rs::synthetic {
namespace {

using capture::Mesh;
using glm::vec3;

// Merges vertices at equal positions, which texture seams and creases duplicate.
struct WeldedMesh {
    std::vector<vec3> positions;
    std::vector<std::array<std::size_t, 3>> triangles;
};

WeldedMesh weld(const Mesh& mesh) {
    const auto less = [](const vec3& a, const vec3& b) {
        return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    };
    std::map<vec3, std::size_t, decltype(less)> places(less);
    WeldedMesh welded;
    const auto place = [&](unsigned i) {
        const auto [it, added] = places.emplace(mesh.positions[i], welded.positions.size());
        if (added) welded.positions.push_back(mesh.positions[i]);
        return it->second;
    };
    for (const glm::uvec3& t : mesh.triangles) welded.triangles.push_back({place(t.x), place(t.y), place(t.z)});
    return welded;
}

// Number of directed edges without exactly one partner of the opposite direction.
std::size_t unmatched_edges(const WeldedMesh& mesh) {
    std::map<std::pair<std::size_t, std::size_t>, int> directed;
    for (const auto& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) ++directed[{t[k], t[(k + 1) % 3]}];
    }
    std::size_t unmatched = 0;
    for (const auto& [edge, count] : directed) {
        const auto back = directed.find({edge.second, edge.first});
        if (count != 1 || back == directed.end() || back->second != 1) ++unmatched;
    }
    return unmatched;
}

// Signed volume of each connected part; positive where faces look outwards.
std::vector<double> part_volumes(const WeldedMesh& mesh) {
    std::vector<std::size_t> parent(mesh.positions.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const auto& t : mesh.triangles) {
        parent[root(t[1])] = root(t[0]);
        parent[root(t[2])] = root(t[0]);
    }
    std::map<std::size_t, double> volumes;
    for (const auto& t : mesh.triangles) {
        const vec3 a = mesh.positions[t[0]];
        volumes[root(t[0])] +=
            static_cast<double>(glm::dot(a, glm::cross(mesh.positions[t[1]], mesh.positions[t[2]]))) / 6.0;
    }
    std::vector<double> result;
    for (const auto& [part, volume] : volumes) result.push_back(volume);
    return result;
}

void expect_solid_glass(const nlohmann::json& lamp_parameters) {
    const Result<capture::Scene> lamp = generate("lamp", lamp_parameters, 3);
    ASSERT_TRUE(lamp.ok()) << lamp.error().message;
    std::size_t parts = 0;
    for (const Mesh& mesh : lamp->meshes) {
        const capture::Material& material = lamp->materials[static_cast<std::size_t>(mesh.material)];
        if (material.kind != capture::SurfaceKind::glass) continue;
        const WeldedMesh welded = weld(mesh);
        EXPECT_EQ(unmatched_edges(welded), 0U) << mesh.name;
        for (const double volume : part_volumes(welded)) {
            EXPECT_GT(volume, 1e-5) << mesh.name;
            ++parts;
        }
    }
    EXPECT_EQ(parts, 7U) << "font, chimney, oil and four feet";
}

TEST(Glass, IsClosedAndLooksOutwards) {
    expect_solid_glass(nullptr);
}
TEST(Glass, IsClosedWhateverTheFill) {
    for (const double fill : {0.1, 0.37, 0.9}) expect_solid_glass({{"fill", fill}});
}

TEST(Glass, OilStaysInsideTheFont) {
    const Result<capture::Scene> lamp = generate("lamp", {{"fill", 0.9}}, 3);
    ASSERT_TRUE(lamp.ok());
    const auto widest_at = [](const Mesh& mesh, float low, float high) {
        float widest = 0.0F;
        for (const vec3& p : mesh.positions) {
            if (p.y >= low && p.y < high) widest = std::max(widest, p.x * p.x + p.z * p.z);
        }
        return widest;
    };
    const Mesh& glass = lamp->meshes[0];
    const Mesh& oil = lamp->meshes[1];
    int compared = 0;
    for (float y = -0.5F; y < 0.1F; y += 0.02F) {
        const float oil_radius2 = widest_at(oil, y, y + 0.02F);
        if (oil_radius2 == 0.0F) continue;
        EXPECT_LT(oil_radius2, widest_at(glass, y, y + 0.02F)) << y;
        ++compared;
    }
    EXPECT_GT(compared, 10);
}

TEST(Glass, TheTestSeesAMissingFace) {
    const Result<capture::Scene> lamp = generate("lamp", nullptr, 3);
    ASSERT_TRUE(lamp.ok());
    Mesh broken = lamp->meshes[0];
    broken.triangles.pop_back();
    EXPECT_EQ(unmatched_edges(weld(broken)), 3U);
}

}  // namespace
}  // namespace rs::synthetic
