// Selection of the lights of a surface's shader.

#include "compositor/viewer/drawing/surface_tables.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace rs::compositor {
namespace {

GeometryNode one_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, bool two_sided) {
    auto mesh = std::make_shared<Mesh>();
    const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    for (const glm::vec3& corner : {a, b, c}) mesh->vertices.push_back({.position = corner, .normal = normal});
    mesh->indices = {0, 1, 2};
    mesh->two_sided = two_sided;
    GeometryNode node;
    node.mesh = mesh;
    return node;
}

// True if light arrives at one of many points of the triangle, on a lit side.
bool is_lit(const GeometryNode& node, const Light& light) {
    const std::vector<MeshVertex>& at = node.mesh->vertices;
    constexpr int kSteps = 24;
    for (int i = 0; i <= kSteps; ++i) {
        for (int j = 0; i + j <= kSteps; ++j) {
            const glm::dvec3 place = (static_cast<double>(i) * glm::dvec3(at[0].position) +
                                      static_cast<double>(j) * glm::dvec3(at[1].position) +
                                      static_cast<double>(kSteps - i - j) * glm::dvec3(at[2].position)) /
                                     static_cast<double>(kSteps);
            const bool faces = node.mesh->two_sided || glm::dot(glm::dvec3(at[0].normal), light.location - place) > 0;
            if (faces && irradiance_at(light, place).x > 0) return true;
        }
    }
    return false;
}

TEST(SurfaceLights, NoneIsLeftOutThatShinesOnTheSurface) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> within(-1, 1);
    const auto place = [&] { return glm::vec3(within(random), within(random), within(random)); };
    int lit = 0;
    int left_out = 0;
    for (int i = 0; i < 4000; ++i) {
        Scene scene;
        Light spot = point_light(2.0F * place(), glm::vec3(1));
        spot.kind = LightKind::kSpot;
        spot.towards = glm::normalize(glm::dvec3(place()));
        spot.cut_off_rad = 0.8 + 0.75 * static_cast<double>(within(random));
        spot.beam_width_rad = spot.cut_off_rad / 2;
        scene.lights = {spot};
        const GeometryNode node = one_triangle(place(), place(), place(), i % 2 == 0);
        const bool given = !lights_of(scene, node, bounds_of(*node.mesh)).lights.empty();
        const bool shines = is_lit(node, spot);
        EXPECT_TRUE(given || !shines) << i;
        EXPECT_TRUE(!lights_near(scene, node, bounds_of(*node.mesh)).lights.empty() || !shines) << i;
        lit += shines ? 1 : 0;
        left_out += given ? 0 : 1;
    }
    EXPECT_GT(lit, 800);
    EXPECT_GT(left_out, 0.6 * (4000 - lit));
}

// Long floor under a lamp that illuminates its middle; lamps of other triangles are not included.
TEST(SurfaceLights, SpotsBesideTheSurfaceAreLeftOut) {
    Light spot = point_light({0, 3, 0}, glm::vec3(1));
    spot.kind = LightKind::kSpot;
    spot.towards = {0, -1, 0};
    spot.cut_off_rad = spot.beam_width_rad = radians(20);
    Scene scene;
    scene.lights = {spot};
    const auto given = [&](float x) {
        const GeometryNode node = one_triangle({x, 0, 0}, {x + 0.1F, 0, 0}, {x, 0, -0.1F}, false);
        return lights_of(scene, node, bounds_of(*node.mesh)).lights.size();
    };
    EXPECT_EQ(given(0), 1U);
    EXPECT_EQ(given(1.05F), 1U);  // the beam ends at 1.092
    EXPECT_EQ(given(1.25F), 0U);
    EXPECT_EQ(given(-1.4F), 0U);
}

}  // namespace
}  // namespace rs::compositor
