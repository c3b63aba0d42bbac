#pragma once
// Plan of a synthetic turntable session, the ground truth: camera, lens, angles and exposures, drawn from a seed.
//
// The camera is static and the object rotates; see capture/calibration/model/turntable_model.hpp. `distance` and
// `camera_height` define the transform from that model's table frame to the scene: scene point = table point * distance
// + (0, camera_height, 0), at angle 0.

#include "capture/calibration/model/turntable_model.hpp"
#include "capture/tracer/image/ray_image.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace rs::capture {

struct SessionOptions {
    int views = 36;   // 1..kMaxViews
    int width = 640;  // px
    int height = 512;
    double focal_widths = 1.4;       // focal length over image width
    std::optional<double> distance;  // camera to target, in the scene's unit; empty = smallest that shows everything
    double elevation_deg = 20;       // of the camera above the target's horizontal plane, 0..85
    double look_at_height = 0;       // height of the target on the axis
    double aim_error_deg = 0.7;      // the largest error of pan, tilt and roll, each
    double k1 = 0;
    double k2 = 0;
    double step_error_deg = 0.3;     // standard deviation of the steps between views, which sum up to a full turn
    double exposure_drift = 0.03;    // amplitude of the slow relative exposure variation
    bool counter_clockwise = false;  // rotation of the object seen from above; default: clockwise as in make_ring()
    std::uint64_t seed = 1;
};

struct SessionPlan {
    TurntableModel model;
    double distance = 0;            // of the camera's centre from the axis
    double camera_height = 0;       // of the camera's centre
    std::vector<double> exposures;  // [view] factors on linear light
};

// A circle about the axis that must be visible as a whole.
struct AxisCircle {
    double radius = 0;
    double height = 0;
};

/// Draws a plan in which all circles `shown` are visible.
/// \return an error if the lens distortion is not invertible at a corner, or if no distance shows all circles
Result<SessionPlan> plan_session(const SessionOptions& options, const std::vector<AxisCircle>& shown);

/// Pinhole camera of a view in the object's frame.
Camera pinhole_camera(const SessionPlan& plan, std::size_t view);

/// Distorted rays of a view in the object's frame.
RayImage lens_rays(const SessionPlan& plan, std::size_t view);

}  // namespace rs::capture
