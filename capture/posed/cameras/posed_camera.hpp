#pragma once
/// \file
/// Cameras of photos taken from anywhere, as structure from motion (COLMAP) and NeRF tools state them: one lens and one
/// pose per photo, in a world frame of any orientation and scale. Input of import_posed_photos().

#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace rs::capture {

/// Lens distortion as OpenCV's calib3d defines it.
struct LensDistortion {
    enum class Model {
        kRadialTangential,  ///< coefficients k1 k2 p1 p2 k3 k4 k5 k6; k4..k6 are those of the denominator
        kFisheye,           ///< coefficients k1 k2 k3 k4 of cv::fisheye; the others are 0
    };
    Model model = Model::kRadialTangential;
    std::array<double, 8> coefficients{};

    /// True if the lens is a pinhole.
    [[nodiscard]] bool is_pinhole() const {
        return model == Model::kRadialTangential && coefficients == std::array<double, 8>{};
    }
};

/// Camera of one photo. `camera` holds the lens without its distortion and, in the axes of conventions.hpp, the pose.
/// Its width and height are 0 if the file does not state them.
struct PosedCamera {
    std::string photo;      ///< name as the file states it: with or without folder and extension
    std::string mask_path;  ///< name of its mask, relative to the file; empty: none
    Camera camera;
    LensDistortion distortion;
};

/// Cameras of a file, in its order.
struct PosedModel {
    std::string where;  ///< name of the file, for messages
    std::vector<PosedCamera> cameras;
    /// Camera axes may be OpenCV's instead of OpenGL's: the file's format does not define them.
    bool has_uncertain_axes = false;
    std::vector<std::string> notes = {};  ///< one line each
};

/// Checks size, focal lengths, principal point and coefficients of a lens from a file: sides of 1 .. kMaxPhotoSide_px,
/// focal lengths of 1e-3 .. 1e7 px, all finite.
Status check_lens(const PosedCamera& camera, const std::string& place);

/// Rigid transform of a camera from its rotation (rows: right, down, forward, in the world) and the translation of
/// p_in_camera = R p + t, as COLMAP, OpenCV and Middlebury state a pose.
glm::dmat4 world_from_opencv_camera(const glm::dmat3& rows, const glm::dvec3& translation);

}  // namespace rs::capture
