#pragma once
// Traversal state of the graph of a VRML file. Pure; private to the VRML reader.

#include "compositor/scene/transform.hpp"
#include "compositor/scene/vrml/graph.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor::vrml {

struct TraversalState {
    glm::dmat4 world_from_node{1.0};
    TransformChain chain;               // same transform, as far as uniform scales can represent it
    std::string deviation;              // description of the difference; empty if none
    std::vector<std::uint32_t> lights;  // directional lights scoped to this subtree
    std::optional<std::size_t> room;    // enclosing room of the scene
    bool inlined = false;               // inside of an included file
    int height = 0;                     // depth of the node

    /// Mean factor on lengths.
    [[nodiscard]] double scale() const;
    /// Pure rotation: right-handed orthogonal axes, without mirroring.
    [[nodiscard]] glm::dmat3 rotation() const;
    [[nodiscard]] glm::dvec3 point(const glm::dvec3& p) const { return glm::dvec3(world_from_node * glm::dvec4(p, 1)); }
};

/// Rotation of VRML's axis and angle; identity if the axis is 0.
glm::dmat4 rotation_matrix(const glm::dvec4& axis_angle);

/// Enters a Transform node.
/// \return false if its scale is 0, so that nothing below is visible.
bool descend(const Node& transform, TraversalState& state);

}  // namespace rs::compositor::vrml
