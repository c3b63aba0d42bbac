#include "compositor/scene/transform.hpp"

#include "rayspace/api/types/check.hpp"

#include <glm/gtc/quaternion.hpp>

#include <cmath>

namespace rs::compositor {

Similarity Similarity::inverse() const {
    const glm::dmat3 back = glm::transpose(rotation);
    return {back, back * (-translation) / scale, 1 / scale};
}

glm::dmat4 Similarity::matrix() const {
    glm::dmat4 result(rotation * scale);
    result[3] = glm::dvec4(translation, 1);
    return result;
}

Similarity operator*(const Similarity& c_from_b, const Similarity& b_from_a) {
    return {c_from_b.rotation * b_from_a.rotation, c_from_b.point(b_from_a.translation),
            c_from_b.scale * b_from_a.scale};
}

NodeTransform NodeTransform::of(const glm::dmat3& orthogonal, double scale) {
    NodeTransform node;
    node.scale = scale;
    node.mirrored = glm::determinant(orthogonal) < 0;
    glm::dmat3 rotation = orthogonal;
    if (node.mirrored) rotation[0] = -rotation[0];
    const glm::dquat turn = glm::normalize(glm::quat_cast(rotation));
    const glm::dvec3 along(turn.x, turn.y, turn.z);
    // The angle from atan2 instead of acos keeps the precision of small rotations.
    if (glm::length(along) > 0) node.axis = along;
    node.angle_rad = 2 * std::atan2(glm::length(along), turn.w);
    return node;
}

Similarity NodeTransform::parent_from_node() const {
    RS_CHECK(scale > 0 && glm::length(axis) > 0);
    // Rodrigues' formula by columns. Rotations about Y give exact zeros, so that upright cameras stay upright.
    const glm::dvec3 n = glm::normalize(axis);
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    const auto turned = [&](const glm::dvec3& v) {
        return v * c + glm::cross(n, v) * s + n * (glm::dot(n, v) * (1 - c));
    };
    return {glm::dmat3(turned({mirrored ? -1 : 1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})), translation, scale};
}

Similarity world_from_node(const TransformChain& chain) {
    Similarity result;
    for (const NodeTransform& node : chain) result = result * node.parent_from_node();
    return result;
}

Camera camera_in_node(const Camera& camera_in_world, const Similarity& world_from_node) {
    const Similarity node_from_world = world_from_node.inverse();
    Camera camera = camera_in_world;
    for (int axis = 0; axis < 3; ++axis) {
        camera.world_from_camera[axis] =
            glm::dvec4(node_from_world.direction(glm::dvec3(camera_in_world.world_from_camera[axis])), 0);
    }
    camera.world_from_camera[3] = glm::dvec4(node_from_world.point(camera_in_world.centre()), 1);
    return camera;
}

}  // namespace rs::compositor
