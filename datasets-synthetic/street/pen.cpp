#include "datasets-synthetic/street/pen.hpp"

#include "datasets-synthetic/shapes/portable_math.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"

#include <vector>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

void append_face(capture::Mesh& mesh, std::span<const vec3> corners, std::span<const vec2> uvs) {
    const auto first = static_cast<unsigned>(mesh.positions.size());
    vec3 normal(0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        normal += glm::cross(corners[i], corners[(i + 1) % corners.size()]);
    }
    normal = glm::normalize(normal);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        mesh.positions.push_back(corners[i]);
        mesh.normals.push_back(normal);
        mesh.uvs.push_back(uvs[i]);
    }
    for (unsigned i = 1; i + 1 < corners.size(); ++i) mesh.triangles.emplace_back(first, first + i, first + i + 1);
}

}  // namespace

void Pen::set_frame(vec3 origin, float turn_deg) {
    frame_ = {origin, rotation({0, 1, 0}, static_cast<float>(radians(static_cast<double>(turn_deg))))};
}

capture::Mesh& Pen::add(const std::string& look) {
    RS_CHECK(world_.looks.contains(look));
    world_.parts.push_back({object_, look, -1, {}});
    return world_.parts.back().mesh;
}

void Pen::finish(capture::Mesh& mesh) const {
    for (vec3& p : mesh.positions) p = frame_.point(p);
    for (vec3& n : mesh.normals) n = frame_.direction(n);
}

void Pen::quad(const std::string& look, const std::array<vec3, 4>& corners, const std::array<vec2, 4>& uvs) {
    capture::Mesh& mesh = add(look);
    append_face(mesh, corners, uvs);
    finish(mesh);
}

void Pen::wall(const std::string& look, vec2 low, vec2 high, float z, float tile_m) {
    quad(look, {vec3{low.x, low.y, z}, {high.x, low.y, z}, {high.x, high.y, z}, {low.x, high.y, z}},
         {low / tile_m, vec2{high.x, low.y} / tile_m, high / tile_m, vec2{low.x, high.y} / tile_m});
}

void Pen::box(const std::string& look, vec3 low, vec3 high, float tile_m) {
    capture::Mesh& mesh = add(look);
    const vec3 d = high - low;
    const auto side = [&](vec3 corner, vec3 right, vec3 up) {
        const vec2 size = vec2{glm::length(right), glm::length(up)} / tile_m;
        append_face(mesh, std::array{corner, corner + right, corner + right + up, corner + up},
                    std::array{vec2{0, 0}, vec2{size.x, 0}, size, vec2{0, size.y}});
    };
    side({low.x, low.y, high.z}, {d.x, 0, 0}, {0, d.y, 0});
    side({high.x, low.y, high.z}, {0, 0, -d.z}, {0, d.y, 0});
    side({high.x, low.y, low.z}, {-d.x, 0, 0}, {0, d.y, 0});
    side(low, {0, 0, d.z}, {0, d.y, 0});
    side({low.x, high.y, high.z}, {d.x, 0, 0}, {0, 0, -d.z});
    finish(mesh);
}

void Pen::cylinder(const std::string& look, const Cylinder& shape) {
    const auto [foot, axis, radius, length, segments, end_radius_share] = shape;
    capture::Mesh& mesh = add(look);
    const vec3 u = any_perpendicular(axis);
    const vec3 v = glm::cross(axis, u);
    std::vector<vec3> lower;
    std::vector<vec3> upper;
    for (int i = 0; i < segments; ++i) {
        const float angle = portable::kTwoPiF * static_cast<float>(i) / static_cast<float>(segments);
        const vec3 out = u * portable::cos(angle) + v * portable::sin(angle);
        lower.push_back(foot + radius * out);
        upper.push_back(foot + radius * end_radius_share * out + length * axis);
        for (const vec3& p : {lower.back(), upper.back()}) {
            mesh.positions.push_back(p);
            mesh.normals.push_back(out);
            mesh.uvs.emplace_back(static_cast<float>(i) / static_cast<float>(segments), glm::dot(p - foot, axis));
        }
    }
    const auto n = static_cast<unsigned>(segments);
    for (unsigned i = 0; i < n; ++i) {
        const unsigned next = (i + 1) % n;
        mesh.triangles.emplace_back(2 * i, 2 * next, 2 * next + 1);
        mesh.triangles.emplace_back(2 * i, 2 * next + 1, 2 * i + 1);
    }
    const std::vector<vec2> uvs(lower.size(), vec2{0.5F, 0.5F});
    append_face(mesh, upper, uvs);
    append_face(mesh, std::vector<vec3>(lower.rbegin(), lower.rend()), uvs);
    finish(mesh);
}

void Pen::surface(const std::string& look, const std::function<void(capture::Mesh&)>& append) {
    capture::Mesh& mesh = add(look);
    append(mesh);
    finish(mesh);
}

}  // namespace rs::synthetic
