#pragma once
// Orthonormal right-handed frame of a part in its object, and rotations without the C library's trigonometry. Pure
// functions.

#include "datasets-synthetic/shapes/portable_math.hpp"

#include <glm/glm.hpp>

#include <cmath>

namespace rs::synthetic {

// Columns of the rotation are the frame's axes in the object.
struct Frame {
    glm::vec3 origin{0.0F};
    glm::mat3 axes{1.0F};

    [[nodiscard]] glm::vec3 point(glm::vec3 p_in_part) const { return origin + axes * p_in_part; }
    [[nodiscard]] glm::vec3 direction(glm::vec3 d_in_part) const { return axes * d_in_part; }
    [[nodiscard]] glm::vec3 point_in_part(glm::vec3 p) const { return (p - origin) * axes; }
};

// Rotation by `angle_rad` about the unit vector `axis`, counter-clockwise when the axis points at the viewer
// (Rodrigues).
inline glm::mat3 rotation(glm::vec3 axis, float angle_rad) {
    const float c = portable::cos(angle_rad);
    const float s = portable::sin(angle_rad);
    const float k = 1.0F - c;
    return {glm::vec3{c + axis.x * axis.x * k, axis.y * axis.x * k + axis.z * s, axis.z * axis.x * k - axis.y * s},
            glm::vec3{axis.x * axis.y * k - axis.z * s, c + axis.y * axis.y * k, axis.z * axis.y * k + axis.x * s},
            glm::vec3{axis.x * axis.z * k + axis.y * s, axis.y * axis.z * k - axis.x * s, c + axis.z * axis.z * k}};
}

// A unit vector perpendicular to the unit vector `d`.
inline glm::vec3 any_perpendicular(glm::vec3 d) {
    const glm::vec3 other = std::abs(d.y) < 0.9F ? glm::vec3{0, 1, 0} : glm::vec3{1, 0, 0};
    return glm::normalize(glm::cross(other, d));
}

// Frame at `origin` with Y axis `up` (any length) and the Z axis as close to `facing` as possible.
inline Frame frame_facing(glm::vec3 origin, glm::vec3 up, glm::vec3 facing) {
    const glm::vec3 y = glm::normalize(up);
    glm::vec3 z = facing - y * glm::dot(facing, y);
    z = glm::dot(z, z) > 1e-10F ? glm::normalize(z) : any_perpendicular(y);
    return {origin, glm::mat3{glm::cross(y, z), y, z}};
}

}  // namespace rs::synthetic
