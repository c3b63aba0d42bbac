#include "compositor/viewer/views/frustum.hpp"

namespace rs::compositor {

FrameView view_of_frame(const Camera& camera) {
    // Points have camera coordinates: right, up, back.
    glm::dmat4 m(0.0);
    m[0][0] = 2 * camera.fl_x / camera.width;
    m[1][1] = 2 * camera.fl_y / camera.height;
    m[2][0] = 1 - 2 * camera.cx / camera.width;
    m[2][1] = 2 * camera.cy / camera.height - 1;
    m[2][3] = -1;
    m[3][2] = kNear;
    return {camera, m * glm::inverse(camera.world_from_camera)};
}

bool may_be_seen(const BoundingBox& box, const FrameView& view) {
    if (box.empty()) return false;
    // A box is outside where all corners are on the wrong side of one plane.
    int outside = 0x1f;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p((corner & 1) != 0 ? box.highest.x : box.lowest.x,
                           (corner & 2) != 0 ? box.highest.y : box.lowest.y,
                           (corner & 4) != 0 ? box.highest.z : box.lowest.z);
        const glm::dvec4 clip = view.clip_from_world * glm::dvec4(p, 1);
        outside &= (clip.x < -clip.w ? 1 : 0) | (clip.x > clip.w ? 2 : 0) | (clip.y < -clip.w ? 4 : 0) |
                   (clip.y > clip.w ? 8 : 0) | (clip.w < kNear ? 16 : 0);
    }
    return outside == 0;
}

}  // namespace rs::compositor
