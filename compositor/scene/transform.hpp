#pragma once
// Transforms of the scene graph, and the viewpoint taken through them into a node's own coordinates (equation 3 of the
// paper). All functions are pure and may be called from any thread.

#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace rs::compositor {

// A map that keeps shapes, or makes them their mirror images: p_in_b = translation + scale * rotation * p_in_a, scale >
// 0. As a variable: b_from_a.
struct Similarity {
    glm::dmat3 rotation{1.0};  // orthogonal; its determinant is -1 where it mirrors
    glm::dvec3 translation{0.0};
    double scale = 1;

    [[nodiscard]] glm::dvec3 point(const glm::dvec3& p) const { return translation + scale * (rotation * p); }
    // Directions keep their length.
    [[nodiscard]] glm::dvec3 direction(const glm::dvec3& d) const { return rotation * d; }
    [[nodiscard]] bool mirrors() const { return glm::determinant(rotation) < 0; }
    [[nodiscard]] Similarity inverse() const;
    [[nodiscard]] glm::dmat4 matrix() const;
};
// c_from_b * b_from_a = c_from_a.
Similarity operator*(const Similarity& c_from_b, const Similarity& b_from_a);

// What one node of the graph does to its children: mirrored and scaled first, then turned, then moved (VRML97's
// Transform).
struct NodeTransform {
    glm::dvec3 translation{0.0};
    glm::dvec3 axis{0.0, 1.0, 0.0};  // of any length but 0
    double angle_rad = 0;
    double scale = 1;       // > 0
    bool mirrored = false;  // x to -x

    // Of an orthogonal matrix and a scale; the translation is 0.
    static NodeTransform of(const glm::dmat3& orthogonal, double scale);

    [[nodiscard]] Similarity parent_from_node() const;
};

// The transforms from the root of the scene down to a node, the root's first.
using TransformChain = std::vector<NodeTransform>;
Similarity world_from_node(const TransformChain& chain);

// Equation 3: the same camera in a node's coordinates. Its pixels show the same directions; depths are divided by the
// chain's scale. Left-handed below a node that mirrors.
Camera camera_in_node(const Camera& camera_in_world, const Similarity& world_from_node);

}  // namespace rs::compositor
