#include "rayspace/geometry/ring_axes.hpp"

#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <cstdint>

namespace rs {
namespace {

double from_q30(std::int32_t value) {
    return std::ldexp(value, -30);
}

std::int32_t to_q30(double value) {
    return static_cast<std::int32_t>(std::lround(std::ldexp(value, 30)));
}

}  // namespace

glm::dmat3 ring_from_object(const RingRotation& rotation) {
    return glm::mat3_cast(glm::normalize(glm::dquat(from_q30(rotation.w_q30), from_q30(rotation.x_q30),
                                                    from_q30(rotation.y_q30), from_q30(rotation.z_q30))));
}

RingRotation ring_rotation(const glm::dmat3& ring_from_object) {
    glm::dquat q = glm::normalize(glm::quat_cast(ring_from_object));
    if (q.w < 0) q = -q;
    return {to_q30(q.x), to_q30(q.y), to_q30(q.z), to_q30(q.w)};
}

Camera in_ring_axes(Camera camera, const RingRotation& rotation) {
    if (!rotation.is_identity()) {
        camera.world_from_camera = glm::dmat4(ring_from_object(rotation)) * camera.world_from_camera;
    }
    return camera;
}

Camera in_object_axes(Camera camera_in_ring, const RingRotation& rotation) {
    if (!rotation.is_identity()) {
        camera_in_ring.world_from_camera =
            glm::dmat4(glm::transpose(ring_from_object(rotation))) * camera_in_ring.world_from_camera;
    }
    return camera_in_ring;
}

}  // namespace rs
