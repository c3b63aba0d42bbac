#include "compositor/scene/vrml1/placement.hpp"

#include "compositor/scene/vrml/traversal_state.hpp"

#include <glm/gtc/quaternion.hpp>

#include <cmath>

namespace rs::compositor::vrml1 {
namespace {

glm::dmat4 moved(const glm::dvec3& by) {
    glm::dmat4 m(1.0);
    m[3] = glm::dvec4(by, 1);
    return m;
}

glm::dmat4 scaled(const glm::dvec3& by) {
    glm::dmat4 m(1.0);
    for (int axis = 0; axis < 3; ++axis) m[axis][axis] = by[axis];
    return m;
}

glm::dmat4 turned(const Tree& node, const char* key) {
    const std::vector<double>& n = node.field(key).numbers;
    return vrml::rotation_matrix({n.at(0), n.at(1), n.at(2), n.at(3)});
}

glm::dvec4 axis_and_angle(const glm::dmat3& rotation) {
    const glm::dquat q = glm::normalize(glm::quat_cast(rotation));
    const glm::dvec3 axis(q.x, q.y, q.z);
    const double sine = glm::length(axis);
    if (!(sine > 1e-12)) return {0, 0, 1, 0};
    return {axis / sine, 2 * std::atan2(sine, q.w)};
}

// Nearest rotation to an invertible matrix without mirroring: Newton's iteration.
glm::dmat3 nearest_rotation(glm::dmat3 m) {
    for (int i = 0; i < 100; ++i) {
        const glm::dmat3 back = glm::transpose(glm::inverse(m));
        // Scaling by the ratio of sizes makes it converge in a few steps.
        const double size = std::sqrt(std::cbrt(std::abs(glm::determinant(back) / glm::determinant(m))));
        const glm::dmat3 next = 0.5 * (size * m + back / size);
        double change = 0;
        for (int c = 0; c < 3; ++c) change += glm::length(next[c] - m[c]);
        m = next;
        if (change < 1e-15) break;
    }
    return m;
}

// Axes of a symmetric matrix by Jacobi rotations; `m` becomes diagonal.
glm::dmat3 principal_axes(glm::dmat3& m) {
    glm::dmat3 axes(1.0);
    for (int sweep = 0; sweep < 30; ++sweep) {
        for (const auto& [p, q] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
            if (std::abs(m[p][q]) <= 1e-12 * (std::abs(m[p][p]) + std::abs(m[q][q]))) continue;
            const double angle = 0.5 * std::atan2(2 * m[p][q], m[p][p] - m[q][q]);
            glm::dmat3 turn(1.0);
            turn[p][p] = turn[q][q] = std::cos(angle);
            turn[p][q] = std::sin(angle);
            turn[q][p] = -std::sin(angle);
            m = glm::transpose(turn) * m * turn;
            axes = axes * turn;
        }
    }
    return axes;
}

}  // namespace

std::optional<glm::dmat4> matrix_of(const Tree& node) {
    if (node.type == "Translation") return moved(node.triple("translation"));
    if (node.type == "Rotation") return turned(node, "rotation");
    if (node.type == "Scale") return scaled(node.triple("scaleFactor"));
    if (node.type == "MatrixTransform") {
        // VRML 1.0 transforms row vectors, so its rows are our columns.
        const std::vector<double>& n = node.field("matrix").numbers;
        glm::dmat4 m(1.0);
        for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = n.at(static_cast<std::size_t>(i));
        for (int column = 0; column < 4; ++column) m[column][3] = column == 3 ? 1 : 0;
        return m;
    }
    if (node.type != "Transform") return std::nullopt;
    const glm::dmat4 stretch = turned(node, "scaleOrientation");
    return moved(node.triple("translation") + node.triple("center")) * turned(node, "rotation") * stretch *
           scaled(node.triple("scaleFactor")) * glm::transpose(stretch) * moved(-node.triple("center"));
}

std::optional<Placement> placement_of(const glm::dmat4& matrix) {
    glm::dmat3 linear(matrix);
    const double determinant = glm::determinant(linear);
    const double size = glm::length(linear[0]) + glm::length(linear[1]) + glm::length(linear[2]);
    if (!std::isfinite(determinant) || !std::isfinite(glm::length(glm::dvec3(matrix[3]))) ||
        !(std::abs(determinant) > 1e-12 * size * size * size) || !(std::abs(determinant) > 1e-30)) {
        return std::nullopt;
    }
    const double sign = determinant < 0 ? -1 : 1;
    const glm::dmat3 rotation = nearest_rotation(sign * linear);
    glm::dmat3 stretch = glm::transpose(rotation) * linear;
    stretch = 0.5 * (stretch + glm::transpose(stretch));
    const glm::dmat3 axes = principal_axes(stretch);
    Placement placement;
    placement.translation = glm::dvec3(matrix[3]);
    placement.rotation = axis_and_angle(rotation);
    placement.scale = {stretch[0][0], stretch[1][1], stretch[2][2]};
    placement.scale_orientation = axis_and_angle(axes);
    return placement;
}

}  // namespace rs::compositor::vrml1
