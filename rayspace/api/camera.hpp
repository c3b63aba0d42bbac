#pragma once
/// \file
/// Cameras of views and of photos.
///
/// Axes: right-handed, Y up; the turntable's axis is the Y axis. A camera has OpenGL axes: +X right, +Y up, it looks
/// along -Z. Pixels: the origin is the top left corner, y goes down, pixel centres are at +0.5. Lengths are in the
/// units of the object's capture set (Object::units_per_radius() of them are one object radius), unless stated
/// otherwise.

#include "rayspace/api/result.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rs::api {

/// Point or direction: x, y, z.
using Vector3 = std::array<double, 3>;

/// 4x4 matrix as rows: m[row][column].
using Matrix4 = std::array<std::array<double, 4>, 4>;

/// Pinhole camera.
struct Camera {
    int width = 0;    ///< px, 1..8192
    int height = 0;   ///< px, 1..8192
    double fl_x = 0;  ///< focal length, px, > 0
    double fl_y = 0;  ///< focal length, px, > 0
    double cx = 0;    ///< principal point, px from the left edge; width / 2 is the middle
    double cy = 0;    ///< principal point, px from the top edge
    /// Camera to world: columns are right, up, back and centre; the `transform_matrix` of a NeRF transforms.json. The
    /// upper left 3x3 part is a rotation.
    Matrix4 world_from_camera{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
};

/// Camera of a photo of a capture set.
struct CapturedCamera {
    std::string file;  ///< path of the photo relative to the set's folder; may lack ".png"
    Camera camera;     ///< in the set's units
};

/// Size and field of view of a view that is otherwise as captured.
struct ViewShape {
    std::optional<int> width = {};         ///< px; as captured if not given
    std::optional<int> height = {};        ///< px; as captured if not given
    std::optional<double> fov_x_rad = {};  ///< horizontal field of view, 0..pi; the whole captured frame if not given
};

/// Camera with square pixels and the principal point in the middle. Thread-safe.
/// \param eye        position
/// \param target     point in the middle of the view; differs from `eye`
/// \param fov_x_rad  horizontal field of view, 0..pi
/// \param width      px, 1..8192
/// \param height     px, 1..8192
/// \return the camera, its up vector towards +Y (+Z if the view is vertical); an error that names the argument
Result<Camera> look_at(const Vector3& eye, const Vector3& target, double fov_x_rad, int width, int height);

/// Reads the cameras of a capture set. Thread-safe.
/// \param set  a folder with a transforms.json as of NeRF tools, or that file
/// \return one camera per frame, in the file's order; an error that names the file and the frame
Result<std::vector<CapturedCamera>> read_cameras(const std::filesystem::path& set);

}  // namespace rs::api
