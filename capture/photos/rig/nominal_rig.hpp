#pragma once
/// \file
/// Nominal rig of an uncalibrated turntable: equal steps around a vertical axis, a level camera, a plausible lens.
///
/// Its rays are accurate enough to show the object turning. Unknown values (the lens, the camera's height) are assumed:
///   - The camera is level with the middle of the visible part of the object and looks at the axis. A real camera may
///     look down; the object then appears slightly tilted, equally from all sides.
///   - The principal point is not the image centre but the projection of the axis at that middle height, so images are
///     neither cropped nor shifted: cx = axis column, cy = middle row of the visible box.
///   - The unit of length is the object radius. With w the widest extent from the axis column in px and f the focal
///     length in px, the outermost ray is tangent to the circle of radius r about the axis: sin(atan(w / f)) = r / d,
///     so the camera is at the distance d = r sqrt(w^2 + f^2) / w from the axis.

#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/segmentation/segment_turn.hpp"
#include "capture/photos/segmentation/turn_silhouette.hpp"
#include "rayspace/geometry/rig.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rs::capture {

/// Sense of the object's rotation, as seen from above.
enum class Turning { kClockwise, kCounterClockwise };
std::string to_string(Turning turning);  ///< "clockwise", "counter-clockwise"

/// Horizontal field of view if it is unknown. Product photos are taken from a distance: 25 degrees correspond to a lens
/// of 80 mm with a sensor 36 mm wide.
inline constexpr double kNominalFieldOfView_deg = 25;

/// Input of make_nominal_rig().
struct NominalRigOptions {
    int width = 0;   ///< px, of all images
    int height = 0;  ///< px
    int views = 0;
    double fov_deg = kNominalFieldOfView_deg;  ///< horizontal
    double step_deg = 0;                       ///< between neighbouring views; 360 / views for a full turn
    double axis_x_px = 0;                      ///< column of the axis
    /// Rotation of the *object*. Clockwise: its front moves to the left, as if the camera moved around to the right
    /// (towards +X from +Z), as in make_ring().
    Turning turning = Turning::kClockwise;
};

/// Distance from the axis of a camera whose outermost ray, `extent_px` beside the axis, is tangent to a circle of
/// radius 1 about the axis. `fl_px` is the focal length. Both are positive.
double distance_for_unit_radius(double extent_px, double fl_px);

/// Makes the nominal rig: views without file names, object_radius 1. `visible` is in px, not empty, and extends to at
/// least one side of the axis.
Rig make_nominal_rig(const NominalRigOptions& options, const TurnSilhouette::Box& visible);

/// Axis column and direction of rotation, estimated from the foreground images without calibration. Input of the
/// nominal rig and start of calibration.
struct NominalTurn {
    double fov_deg = kNominalFieldOfView_deg;  ///< horizontal
    std::string fov_from;                      ///< "given", "camera" (EXIF), "assumed"
    double step_deg = 0;                       ///< between neighbouring views
    double axis_x_px = 0;                      ///< column of the axis
    double axis_spread_px = 0;                 ///< spread of the axis column over the rows
    std::string axis_from;                     ///< "silhouettes", "given", "image middle"
    Turning turning = Turning::kClockwise;
    std::string turning_from;        ///< "images", "given", "assumed"; empty before estimate_turning()
    std::vector<std::string> notes;  ///< doubtful values, one line each
};

/// Values given by the user. Missing ones are estimated or assumed.
struct NominalTurnRequest {
    std::optional<double> fov_deg;           ///< horizontal, 1..120
    std::optional<double> degrees_per_view;  ///< 0.01..180
    std::optional<Turning> turning;
    std::optional<double> axis_x_px;  ///< column of the axis
};

/// Estimates everything except `turning` and `turning_from`.
NominalTurn find_nominal_turn(const NominalTurnRequest& request, const PhotoFolder& folder, const SegmentedTurn& turn);

/// Sets `turning` and `turning_from` of `found`, the result of find_nominal_turn() for the same turn. Compares the
/// small foreground images unless the request holds the direction of rotation.
void estimate_turning(const NominalTurnRequest& request, const PhotoFolder& folder, const SegmentedTurn& turn,
                      NominalTurn& found);

}  // namespace rs::capture
