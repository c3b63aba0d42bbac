#include "rayspace/api/camera.hpp"

#include "rayspace/api/internal/type_conversion.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/result.hpp"

#include <cmath>

namespace rs::api {

rs::Camera to_internal(const Camera& camera) {
    rs::Camera internal{camera.width, camera.height, camera.fl_x, camera.fl_y, camera.cx, camera.cy};
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            internal.world_from_camera[column][row] =
                camera.world_from_camera[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
        }
    }
    return internal;
}

Camera to_public(const rs::Camera& camera) {
    Camera shown{camera.width, camera.height, camera.fl_x, camera.fl_y, camera.cx, camera.cy};
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            shown.world_from_camera[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
                camera.world_from_camera[column][row];
        }
    }
    return shown;
}

std::vector<CapturedCamera> cameras_of(const Rig& rig) {
    std::vector<CapturedCamera> cameras;
    for (const RigView& view : rig.views) cameras.push_back({view.file_path, to_public(view.camera)});
    return cameras;
}

Result<Camera> look_at(const Vector3& eye, const Vector3& target, double fov_x_rad, int width, int height) {
    const glm::dvec3 from(eye[0], eye[1], eye[2]);
    const glm::dvec3 to(target[0], target[1], target[2]);
    const double distance = glm::distance(from, to);
    if (!(distance > 0) || !std::isfinite(distance)) {
        return Error{"camera: eye and target are the same point or not finite; move one of them"};
    }
    if (!(fov_x_rad > 0 && fov_x_rad < kPi)) return Error{"camera: fov_x_rad is outside 0..pi; give radians"};
    if (width < 1 || height < 1 || width > kMaxImageSide_px || height > kMaxImageSide_px) {
        return Error{"camera: its size of " + std::to_string(width) + "x" + std::to_string(height) + " is outside 1.." +
                     std::to_string(kMaxImageSide_px) + " pixels"};
    }
    return to_public(look_at_camera(from, to, fov_x_rad, width, height));
}

Result<std::vector<CapturedCamera>> read_cameras(const std::filesystem::path& set) {
    RS_ASSIGN_OR_RETURN(const Rig rig, read_rig(set));
    return cameras_of(rig);
}

}  // namespace rs::api
