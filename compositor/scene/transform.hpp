#pragma once
// Transforms of the scene graph, and the camera in a node's coordinates (equation 3 of the paper). All functions are
// pure and thread-safe.

#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace rs::compositor {

/// Similarity transform, possibly mirroring: p_in_b = translation + scale * rotation * p_in_a, scale > 0. Variables are
/// named b_from_a.
struct Similarity {
    glm::dmat3 rotation{1.0};  // orthogonal; determinant -1 if it mirrors
    glm::dvec3 translation{0.0};
    double scale = 1;

    [[nodiscard]] glm::dvec3 point(const glm::dvec3& p) const { return translation + scale * (rotation * p); }
    /// Keeps the length of directions.
    [[nodiscard]] glm::dvec3 direction(const glm::dvec3& d) const { return rotation * d; }
    [[nodiscard]] bool mirrors() const { return glm::determinant(rotation) < 0; }
    [[nodiscard]] Similarity inverse() const;
    [[nodiscard]] glm::dmat4 matrix() const;
};
// c_from_b * b_from_a = c_from_a.
Similarity operator*(const Similarity& c_from_b, const Similarity& b_from_a);

/// Transform of one node: mirror and scale, then rotate, then translate (VRML97's Transform).
struct NodeTransform {
    glm::dvec3 translation{0.0};
    glm::dvec3 axis{0.0, 1.0, 0.0};  // of any length but 0
    double angle_rad = 0;
    double scale = 1;       // > 0
    bool mirrored = false;  // x to -x

    /// Matrix of a rotation and a scale, without translation.
    static NodeTransform of(const glm::dmat3& orthogonal, double scale);

    [[nodiscard]] Similarity parent_from_node() const;
};

/// Transforms from the root down to a node, root first.
using TransformChain = std::vector<NodeTransform>;
Similarity world_from_node(const TransformChain& chain);

/// Equation 3: the camera in a node's coordinates. Pixels keep their directions; depths are divided by the chain's
/// scale. Left-handed if the chain mirrors.
Camera camera_in_node(const Camera& camera_in_world, const Similarity& world_from_node);

}  // namespace rs::compositor
