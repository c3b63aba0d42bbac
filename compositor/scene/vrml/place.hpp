#pragma once
// Where a walk over the graph of a VRML file stands. Pure; private to the VRML reader.

#include "compositor/scene/transform.hpp"
#include "compositor/scene/vrml/graph.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor::vrml {

struct Place {
    glm::dmat4 world_from_node{1.0};
    TransformChain chain;               // the same as far as a chain can hold it: even scales
    std::string unlike;                 // how the chain differs; empty where it does not
    std::vector<std::uint32_t> lights;  // directional ones that shine below here only
    std::optional<std::size_t> room;    // of the scene, that this is in
    bool inlined = false;               // in a file that another one includes
    int height = 0;                     // nodes above

    // The mean factor by which lengths grow.
    [[nodiscard]] double scale() const;
    // Rotation only: axes at right angles, right-handed, whatever is mirrored.
    [[nodiscard]] glm::dmat3 rotation() const;
    [[nodiscard]] glm::dvec3 point(const glm::dvec3& p) const { return glm::dvec3(world_from_node * glm::dvec4(p, 1)); }
};

// Rotation by VRML's axis and angle; none where the axis is 0.
glm::dmat4 rotation_matrix(const glm::dvec4& axis_angle);

// Below a Transform node. False where its scale is 0, so that nothing of it can be seen.
bool descend(const Node& transform, Place& place);

}  // namespace rs::compositor::vrml
