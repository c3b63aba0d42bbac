#pragma once
// Shapes, cameras and averages shared by the tracer's tests.

#include "capture/tracer/integrator/tracer.hpp"
#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/camera.hpp"

#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace rs::capture::test {

inline Material material_of(SurfaceKind kind, glm::vec3 colour = glm::vec3(1.0F), float roughness = 0.3F) {
    Material material;
    material.name = "test";
    material.kind = kind;
    material.colour = colour;
    material.roughness = roughness;
    return material;
}

// A sphere of radius 1 about the origin: an icosahedron, each triangle split in four `splits` times.
inline Mesh make_sphere(int splits, bool smooth = true) {
    const float g = 1.6180339887F;
    Mesh mesh;
    mesh.name = "sphere";
    mesh.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (int split = 0; split < splits; ++split) {
        std::map<std::pair<unsigned, unsigned>, unsigned> middles;
        const auto middle = [&](unsigned a, unsigned b) {
            const auto [entry, is_new] =
                middles.try_emplace(std::minmax(a, b), static_cast<unsigned>(mesh.positions.size()));
            if (is_new) mesh.positions.push_back(mesh.positions[a] + mesh.positions[b]);
            return entry->second;
        };
        std::vector<glm::uvec3> finer;
        for (const glm::uvec3& t : mesh.triangles) {
            for (unsigned v : {t.x, t.y, t.z}) mesh.positions[v] = glm::normalize(mesh.positions[v]);
            const unsigned a = middle(t.x, t.y);
            const unsigned b = middle(t.y, t.z);
            const unsigned c = middle(t.z, t.x);
            finer.insert(finer.end(), {{t.x, a, c}, {t.y, b, a}, {t.z, c, b}, {a, b, c}});
        }
        mesh.triangles = std::move(finer);
        for (glm::vec3& p : mesh.positions) p = glm::normalize(p);
    }
    for (glm::vec3& p : mesh.positions) p = glm::normalize(p);
    if (smooth) mesh.normals = mesh.positions;
    return mesh;
}

// The parallelogram corner + s u + t v; its outer side is in the direction of cross(u, v). Texture coordinates are (s,
// t).
inline Mesh make_quad(glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
    Mesh mesh;
    mesh.name = "quad";
    mesh.positions = {corner, corner + u, corner + u + v, corner + v};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

// A large quad in the plane y = 0.
inline Mesh floor_quad() {
    return make_quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100});
}

inline Environment constant_environment(float radiance) {
    Environment environment;
    environment.pixels = Image<RgbaF>(1, 1, {radiance, radiance, radiance, 1});
    return environment;
}

inline Scene scene_of(Mesh mesh, const Material& material) {
    Scene scene;
    scene.name = "test";
    scene.meshes.push_back(std::move(mesh));
    scene.materials.push_back(material);
    return scene;
}

// Looks at the origin from +Z, `distance` away.
inline Camera front_camera(double distance, double fov_x_deg, int side_px) {
    return look_at_camera({0, 0, distance}, {0, 0, 0}, radians(fov_x_deg), side_px, side_px);
}

inline Rendering render(Scene scene, const Camera& camera, const RenderOptions& options) {
    const Result<Tracer> tracer = Tracer::create(std::move(scene));
    if (!tracer) {
        ADD_FAILURE() << tracer.error().message;
        return {Image<RgbaF>(camera.width, camera.height), {}};
    }
    return tracer->render(camera, options);
}

// Mean colour weighted by coverage.
inline glm::dvec3 mean_radiance(const Image<RgbaF>& image) {
    glm::dvec3 sum(0);
    double weight = 0;
    for (const RgbaF& p : image.pixels()) {
        sum += glm::dvec3(p.r, p.g, p.b) * static_cast<double>(p.a);
        weight += static_cast<double>(p.a);
    }
    EXPECT_GT(weight, 0.0) << "nothing was hit";
    return sum / weight;
}

}  // namespace rs::capture::test
