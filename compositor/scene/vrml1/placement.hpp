#pragma once
// VRML 1.0 transformations as matrices, and matrices as the fields of VRML97's Transform. Pure; thread-safe.

#include "compositor/scene/vrml1/tree.hpp"

#include <glm/glm.hpp>

#include <optional>

namespace rs::compositor::vrml1 {

/// Matrix of a Transform, Translation, Rotation, Scale or MatrixTransform; nullopt for other nodes.
std::optional<glm::dmat4> matrix_of(const Tree& node);

// matrix = translation * rotation * (scaleOrientation * scale * scaleOrientation^-1), rotations as axis and angle.
struct Placement {
    glm::dvec3 translation{0};
    glm::dvec4 rotation{0, 0, 1, 0};
    glm::dvec3 scale{1};
    glm::dvec4 scale_orientation{0, 0, 1, 0};
};
/// \return nullopt if the matrix is singular.
std::optional<Placement> placement_of(const glm::dmat4& matrix);

}  // namespace rs::compositor::vrml1
