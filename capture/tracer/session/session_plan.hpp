#pragma once
// The truth of a photographed turn, before any image is taken: camera, lens, angles and exposures, drawn from a seed.
//
// The camera stands still in the room and the object turns; see capture/calibration/model/turntable_model.hpp.
// `distance` and `camera_height` place that model's table frame in the scene: a table point p stands at p * distance +
// (0, camera_height, 0) in the scene's coordinates as they are at angle 0.

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
    std::optional<double> distance;  // camera to target, in the scene's unit; empty = as near as everything fits in
    double elevation_deg = 20;       // of the camera above the target's horizontal plane, 0..85
    double look_at_height = 0;       // of the target on the axis
    double aim_error_deg = 0.7;      // the largest error of pan, tilt and roll, each
    double k1 = 0;
    double k2 = 0;
    double step_error_deg = 0.3;     // standard deviation of a step from view to view; the steps still add up to a turn
    double exposure_drift = 0.03;    // largest relative change of the exposure, which comes and goes slowly
    bool counter_clockwise = false;  // how the object turns, seen from above; clockwise as in make_ring()
    std::uint64_t seed = 1;
};

struct SessionPlan {
    TurntableModel model;
    double distance = 0;            // of the camera's centre from the axis
    double camera_height = 0;       // of the camera's centre
    std::vector<double> exposures;  // [view] factors on linear light
};

// A circle about the axis that images should show whole.
struct AxisCircle {
    double radius = 0;
    double height = 0;
};

// Fails where the lens folds a corner of the image back, and where no distance shows all circles.
Result<SessionPlan> plan_session(const SessionOptions& options, const std::vector<AxisCircle>& shown);

// View `view` without the lens' distortion, in the object's frame.
Camera pinhole_of(const SessionPlan& plan, std::size_t view);

// View `view` as the lens sees it, in the object's frame.
RayImage lens_rays_of(const SessionPlan& plan, std::size_t view);

}  // namespace rs::capture
