#include "compositor/scene/vrml/traversal_state.hpp"

#include <algorithm>
#include <cmath>

namespace rs::compositor::vrml {
namespace {

glm::dmat4 translation_matrix(const glm::dvec3& by) {
    glm::dmat4 m(1.0);
    m[3] = glm::dvec4(by, 1);
    return m;
}

glm::dmat4 scale_matrix(const glm::dvec3& by) {
    glm::dmat4 m(1.0);
    for (int axis = 0; axis < 3; ++axis) m[axis][axis] = by[axis];
    return m;
}

}  // namespace

double TraversalState::scale() const {
    return std::cbrt(std::abs(glm::determinant(glm::dmat3(world_from_node))));
}

glm::dmat3 TraversalState::rotation() const {
    const glm::dmat3 m(world_from_node);
    const glm::dvec3 back = glm::normalize(m[2]);
    const glm::dvec3 up = glm::normalize(m[1] - back * glm::dot(m[1], back));
    return {glm::cross(up, back), up, back};
}

glm::dmat4 rotation_matrix(const glm::dvec4& axis_angle) {
    const glm::dvec3 axis(axis_angle);
    if (!(glm::length(axis) > 0)) return glm::dmat4(1.0);
    NodeTransform turn;
    turn.axis = axis;
    turn.angle_rad = axis_angle.w;
    return turn.parent_from_node().matrix();
}

bool descend(const Node& transform, TraversalState& state) {
    const glm::dvec3 centre = transform.triple("center");
    const glm::dvec3 translation = transform.triple("translation");
    const glm::dvec3 scale = transform.triple("scale");
    const glm::dvec4 turn = transform.quadruple("rotation");
    const glm::dmat4 stretch = rotation_matrix(transform.quadruple("scaleOrientation"));
    const glm::dmat4 local = translation_matrix(translation + centre) * rotation_matrix(turn) * stretch *
                             scale_matrix(scale) * glm::transpose(stretch) * translation_matrix(-centre);
    state.world_from_node = state.world_from_node * local;
    const double smallest = std::min({std::abs(scale.x), std::abs(scale.y), std::abs(scale.z)});
    const double determinant = glm::determinant(glm::dmat3(state.world_from_node));
    if (!(smallest > 1e-9) || !std::isfinite(determinant) || !(std::abs(determinant) > 1e-30) ||
        !std::isfinite(glm::length(glm::dvec3(state.world_from_node[3])))) {
        return false;
    }
    const glm::dvec3 sizes = glm::abs(scale);
    if (std::max({sizes.x, sizes.y, sizes.z}) > smallest * 1.0001) state.deviation = "is stretched more along one axis";

    NodeTransform node;
    node.translation = translation + centre;
    if (glm::length(glm::dvec3(turn)) > 0) node.axis = glm::dvec3(turn);
    node.angle_rad = turn.w;
    node.scale = std::cbrt(sizes.x * sizes.y * sizes.z);
    state.chain.push_back(node);
    if (scale != sizes) {
        const glm::dmat3 axes(stretch);
        const glm::dvec3 signs = glm::sign(scale);
        const glm::dmat3 mirror(signs.x, 0, 0, 0, signs.y, 0, 0, 0, signs.z);
        state.chain.push_back(NodeTransform::of(axes * mirror * glm::transpose(axes), 1));
    }
    if (centre != glm::dvec3(0)) {
        NodeTransform back;
        back.translation = -centre;
        state.chain.push_back(back);
    }
    return true;
}

}  // namespace rs::compositor::vrml
