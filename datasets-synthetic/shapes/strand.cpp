#include "datasets-synthetic/shapes/strand.hpp"

namespace rs::synthetic {

using glm::vec3;

void append_strand(capture::Mesh& mesh, const Strand& strand, int segments) {
    // How far the normals lean sideways at the ribbon's edges: 27 degrees.
    constexpr float kFan = 0.5F;
    const auto base = static_cast<unsigned>(mesh.positions.size());
    for (int j = 0; j <= segments; ++j) {
        const float t = static_cast<float>(j) / static_cast<float>(segments);
        const vec3 centre = strand.root + strand.length * (strand.direction * t + strand.bend * (t * t));
        const vec3 along = glm::normalize(strand.direction + strand.bend * (2.0F * t));
        const vec3 face = glm::normalize(glm::cross(strand.side, along));
        const vec3 across = glm::cross(along, face);
        const float half_width = 0.5F * strand.width * (1.0F - t * t);
        if (j == segments) {
            mesh.positions.push_back(centre);
            mesh.normals.push_back(face);
            mesh.uvs.emplace_back(strand.u, 1.0F);
            break;
        }
        for (const float edge : {-1.0F, 1.0F}) {
            mesh.positions.push_back(centre + across * (edge * half_width));
            mesh.normals.push_back(glm::normalize(face + across * (edge * kFan)));
            mesh.uvs.emplace_back(strand.u, t);
        }
    }
    for (unsigned j = 0; j + 1 < static_cast<unsigned>(segments); ++j) {
        const unsigned left = base + 2 * j;
        mesh.triangles.emplace_back(left, left + 1, left + 3);
        mesh.triangles.emplace_back(left, left + 3, left + 2);
    }
    const unsigned last = base + 2 * static_cast<unsigned>(segments - 1);
    mesh.triangles.emplace_back(last, last + 1, last + 2);
}

}  // namespace rs::synthetic
