#pragma once
// A rig for a turntable that nobody measured: equal steps around a vertical axis, a level camera, a plausible lens.
//
// It gives where rays go well enough to show the object turning; what it does not know (the lens, the height of the
// camera) it assumes:
//   - The camera is level with the middle of what the pictures show and looks at the axis. It may really look down;
//     then the object seems a little tilted, from every side alike.
//   - The principal point is not the picture's middle but where the axis and that middle height appear, so pictures are
//     neither cropped nor shifted: cx = axis column, cy = middle row of the visible box.
//   - The unit of length is the object radius. With w the widest extent from the axis column in px and f the focal
//   length
//     in px, the outermost ray is tangent to the circle of radius r about the axis: sin(atan(w / f)) = r / d, so the
//     camera stands at d = r sqrt(w^2 + f^2) / w.

#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/segmentation/segment_turn.hpp"
#include "capture/photos/segmentation/turn_silhouette.hpp"
#include "rayspace/geometry/rig.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rs::capture {

// Seen from above.
enum class Turning { kClockwise, kCounterClockwise };
std::string to_string(Turning turning);  // "clockwise", "counter-clockwise"

// Horizontal. Product pictures are taken from far away: 25 degrees is a lens of 80 mm before a 36 mm wide sensor.
inline constexpr double kNominalFieldOfView_deg = 25;

struct NominalRigOptions {
    int width = 0;  // px, of every picture
    int height = 0;
    int views = 0;
    double fov_deg = kNominalFieldOfView_deg;
    double step_deg = 0;  // from view to view; 360 / views for a full turn
    double axis_x_px = 0;
    // How the *object* turns. Clockwise: its front goes to the left, as if the camera went around to the right
    // (towards +X from +Z), as in make_ring().
    Turning turning = Turning::kClockwise;
};

// Distance of a camera whose outermost ray, `extent_px` beside the axis, is tangent to a circle of radius 1 about it.
double distance_for_unit_radius(double extent_px, double fl_px);

// Views without file names, object_radius 1. `visible` must not be empty and must reach to one side of the axis at
// least.
Rig make_nominal_rig(const NominalRigOptions& options, const TurnSilhouette::Box& visible);

// What the cut-outs alone show of a turn that nobody calibrates: the axis' column and the sense of turning. The
// nominal rig stands on it, and calibration begins with it.
struct NominalTurn {
    double fov_deg = kNominalFieldOfView_deg;
    std::string fov_from;  // "given", "camera" (EXIF), "assumed"
    double step_deg = 0;
    double axis_x_px = 0;
    double axis_spread_px = 0;
    std::string axis_from;  // "silhouettes", "given", "picture middle"
    Turning turning = Turning::kClockwise;
    std::string turning_from;        // "pictures", "given", "assumed"; empty: nobody asked for it yet
    std::vector<std::string> notes;  // of what is doubtful, one line each
};

// What is given; the rest is found or assumed.
struct NominalTurnRequest {
    std::optional<double> fov_deg;           // horizontal, 1..120
    std::optional<double> degrees_per_view;  // 0.01..180
    std::optional<Turning> turning;
    std::optional<double> axis_x_px;
};

// All but the sense of turning and where that is from.
NominalTurn find_nominal_turn(const NominalTurnRequest& request, const PhotoFolder& folder, const SegmentedTurn& turn);

// The sense of turning: `found` is of the same. What is given costs nothing; otherwise pictures are compared.
void find_sense(const NominalTurnRequest& request, const PhotoFolder& folder, const SegmentedTurn& turn,
                NominalTurn& found);

}  // namespace rs::capture
