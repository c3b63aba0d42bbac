#pragma once
// Triangles of a world and predicates for tests.

#include "datasets-synthetic/showroom/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace rs::synthetic {

struct WorldTriangle {
    const WorldPart* part = nullptr;
    std::array<glm::dvec3, 3> corners{};

    [[nodiscard]] glm::dvec3 normal() const {
        return glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    }
    // Points on the triangle, at most `step` apart along its sides.
    [[nodiscard]] std::vector<glm::dvec3> samples(double step) const {
        double longest = 0;
        for (std::size_t k = 0; k < 3; ++k)
            longest = std::max(longest, glm::distance(corners[k], corners[(k + 1) % 3]));
        const int n = std::max(1, static_cast<int>(std::ceil(longest / step)));
        std::vector<glm::dvec3> points;
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; i + j <= n; ++j) {
                const double s = static_cast<double>(i) / n;
                const double t = static_cast<double>(j) / n;
                points.push_back(corners[0] + s * (corners[1] - corners[0]) + t * (corners[2] - corners[0]));
            }
        }
        return points;
    }
};

inline std::vector<WorldTriangle> triangles_of(const World& world) {
    std::vector<WorldTriangle> triangles;
    for (const WorldPart& part : world.parts) {
        for (const glm::uvec3& t : part.mesh.triangles) {
            triangles.push_back({&part,
                                 {glm::dvec3(part.mesh.positions.at(t.x)), glm::dvec3(part.mesh.positions.at(t.y)),
                                  glm::dvec3(part.mesh.positions.at(t.z))}});
        }
    }
    return triangles;
}

// Returns true if two triangles in a plane perpendicular to `axis` overlap by more than `margin` (separating axis
// test).
inline bool overlap(const WorldTriangle& a, const WorldTriangle& b, int axis, double margin) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const auto parted_by_side_of = [&](const WorldTriangle& t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 edge = t.corners[(k + 1) % 3] - t.corners[k];
            const glm::dvec2 across = glm::normalize(glm::dvec2(edge[v], -edge[u]));
            double low_a = 1e9;
            double high_a = -1e9;
            double low_b = 1e9;
            double high_b = -1e9;
            for (std::size_t i = 0; i < 3; ++i) {
                const double in_a = glm::dot(across, glm::dvec2(a.corners[i][u], a.corners[i][v]));
                const double in_b = glm::dot(across, glm::dvec2(b.corners[i][u], b.corners[i][v]));
                low_a = std::min(low_a, in_a);
                high_a = std::max(high_a, in_a);
                low_b = std::min(low_b, in_b);
                high_b = std::max(high_b, in_b);
            }
            if (high_a < low_b + margin || high_b < low_a + margin) return true;
        }
        return false;
    };
    return !parted_by_side_of(a) && !parted_by_side_of(b);
}

}  // namespace rs::synthetic
