#pragma once
// Model of a fixed camera in front of a turntable; calibration estimates its parameters.
//
// Table frame        Y up along the turntable's axis, the origin on the axis at the height of the camera's centre. The
//                    unit of length is the distance of the camera's centre from the axis, so the camera is at (0, 0,
//                    1): its position is a convention, only its orientation can be measured.
// Camera             p_in_camera = Rz(roll) * Rx(tilt) * Ry(pan) * (p - (0, 0, 1)) with the camera axes of
//                    rayspace/base/conventions.hpp (+X right, +Y up, looking along -Z). tilt > 0 points down, pan > 0
//                    points to the right of the axis, roll > 0 rotates the image content counter-clockwise; an axis
//                    that is sideways in the image has a roll near +-90 degrees.
// View i             the object is turned by angle i about Y: a point X of the object moves to Ry(angle_i) * X. Ry(t) =
//                    [cos t, 0, sin t; 0, 1, 0; -sin t, 0, cos t]. Positive angles turn the object's front (+Z) to the
//                    right (+X): counter-clockwise as seen from above.
// Lens               x_d = x (1 + k1 r^2 + k2 r^4), x = X / -Z, y = -Y / -Z, r^2 = x^2 + y^2 (Brown's radial terms,
//                    numbered as in OpenCV), then px = cx + f x_d, py = cy + f y_d, pixel centres at +0.5. Square
//                    pixels.

#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace rs::capture {

struct Lens {
    int width = 0;  // px
    int height = 0;
    double f_px = 0;
    double cx = 0;
    double cy = 0;
    double k1 = 0;
    double k2 = 0;
};

struct CameraPose {
    double pan_rad = 0;
    double tilt_rad = 0;
    double roll_rad = 0;
};

struct TurntableModel {
    Lens lens;
    CameraPose pose;
    std::vector<double> angles_rad;  // [view], the first is 0
};

/// camera_from_table rotation without the translation: p_in_camera = result * (p_in_table - (0, 0, 1)).
glm::dmat3 camera_rotation(const CameraPose& pose);

/// Rotates a point of the object frame (at angle 0) by angle_rad about the axis.
glm::dvec3 turned(const glm::dvec3& p_in_object, double angle_rad);

/// Projects a point of the table frame (already turned) to px; nothing if it is not in front of the camera.
std::optional<glm::dvec2> project(const Lens& lens, const CameraPose& pose, const glm::dvec3& p_in_table);

/// The undistorted direction x, y (at -Z = 1, y down) that appears at pixel position `p`, by Newton's method; nothing
/// if the distortion cannot be inverted there (beyond the radius where it folds back).
std::optional<glm::dvec2> undistorted(const Lens& lens, const glm::dvec2& p);

/// The ray through pixel position `p` in the table frame, from (0, 0, 1), unit length; in the object frame of view i it
/// is rotated by -angle_i.
std::optional<glm::dvec3> table_ray(const Lens& lens, const CameraPose& pose, const glm::dvec2& p);

/// table_ray() for many pixels, each ray rotated by `turn_rad` about the axis; the rotation is computed once.
class TableRays {
public:
    TableRays(const Lens& lens, const CameraPose& pose, double turn_rad = 0);
    [[nodiscard]] std::optional<glm::dvec3> through(const glm::dvec2& p) const;

private:
    Lens lens_;
    glm::dmat3 from_camera_;
};

/// The pinhole camera of one view in the object's frame (its world). Distances are scaled by `scale`, and table height
/// `origin_height` becomes Y = 0. The lens distortion is left out.
Camera object_camera(const TurntableModel& model, std::size_t view, double scale = 1, double origin_height = 0);

/// The column at which the axis crosses row `y_px` of the undistorted image (for an axis nearer to upright than to
/// sideways), and the same with columns and rows exchanged. Nothing if they do not cross in front of the camera.
std::optional<double> axis_column(const Lens& lens, const CameraPose& pose, double y_px);
std::optional<double> axis_row(const Lens& lens, const CameraPose& pose, double x_px);

/// True if the axis is nearer to sideways than to upright in the image.
bool has_sideways_axis(const CameraPose& pose);

/// axis_column() at row at_px; axis_row() at column at_px for a sideways axis.
std::optional<double> axis_position(const Lens& lens, const CameraPose& pose, double at_px);

/// The median step from view to view, signed; 0 for fewer than two views.
double median_step(std::span<const double> angles_rad);

}  // namespace rs::capture
