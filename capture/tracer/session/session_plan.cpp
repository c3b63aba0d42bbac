#include "capture/tracer/session/session_plan.hpp"

#include "capture/tracer/session/seeded_draws.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"

#include <cmath>
#include <numeric>
#include <string>

namespace rs::capture {

namespace {

constexpr double kMargin = 0.03;  // free border around the circles, in image heights
constexpr double kMaxDistance = 1000;

enum SessionPurpose : std::uint64_t { kAim = 1, kAngles, kExposure };

// View angles with independent step errors whose mean is 0, so that the steps sum up to a full turn.
std::vector<double> draw_angles(const SessionOptions& options) {
    SeededDraws draws(options.seed, kAngles);
    const auto views = static_cast<std::size_t>(options.views);
    std::vector<double> errors(views);
    for (double& error : errors) error = radians(options.step_error_deg) * draws.normal();
    const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / options.views;
    std::vector<double> angles(views);
    const double sense = options.counter_clockwise ? 1 : -1;
    for (std::size_t i = 1; i < views; ++i) {
        angles[i] = angles[i - 1] + sense * (2 * kPi / options.views + errors[i] - mean);
    }
    return angles;
}

std::vector<double> draw_exposures(const SessionOptions& options) {
    SeededDraws draws(options.seed, kExposure);
    const double phase = draws.uniform(0, 2 * kPi);
    const double waves = draws.uniform(0.6, 1.4);  // over the turn
    std::vector<double> exposures;
    for (int i = 0; i < options.views; ++i) {
        exposures.push_back(1 + options.exposure_drift * std::sin(phase + 2 * kPi * waves * i / options.views));
    }
    return exposures;
}

void place_camera(SessionPlan& plan, const SessionOptions& options, double to_target) {
    const double elevation = radians(options.elevation_deg);
    plan.distance = to_target * std::cos(elevation);
    plan.camera_height = options.look_at_height + to_target * std::sin(elevation);
}

bool are_visible(const SessionPlan& plan, const std::vector<AxisCircle>& circles) {
    const Lens& lens = plan.model.lens;
    const double margin = kMargin * lens.height;
    for (const AxisCircle& circle : circles) {
        if (!(circle.radius < plan.distance)) return false;
        for (int i = 0; i < 64; ++i) {
            const double a = 2 * kPi * i / 64;
            const glm::dvec3 p(circle.radius * std::sin(a), circle.height - plan.camera_height,
                               circle.radius * std::cos(a));
            const auto projected = project(lens, plan.model.pose, p / plan.distance);
            if (!projected || projected->x < margin || projected->y < margin || projected->x > lens.width - margin ||
                projected->y > lens.height - margin) {
                return false;
            }
        }
    }
    return true;
}

Status check_lens(const Lens& lens) {
    for (const glm::dvec2& corner : {glm::dvec2(0, 0), glm::dvec2(lens.width, lens.height)}) {
        if (undistorted(lens, corner)) continue;
        return Error{"lens: k1 = " + std::to_string(lens.k1) + ", k2 = " + std::to_string(lens.k2) +
                     " fold the image's corners back; use smaller values or a longer focal length"};
    }
    return {};
}

}  // namespace

Result<SessionPlan> plan_session(const SessionOptions& options, const std::vector<AxisCircle>& shown) {
    RS_CHECK(options.views >= 1 && options.width > 0 && options.height > 0 && options.focal_widths > 0);
    SessionPlan plan;
    Lens& lens = plan.model.lens;
    lens = {options.width,       options.height,       options.focal_widths * options.width,
            options.width / 2.0, options.height / 2.0, options.k1,
            options.k2};
    RS_TRY(check_lens(lens));

    SeededDraws draws(options.seed, kAim);
    const auto aim_error = [&] { return radians(options.aim_error_deg) * draws.uniform(-1, 1); };
    plan.model.pose.pan_rad = aim_error();
    plan.model.pose.tilt_rad = radians(options.elevation_deg) + aim_error();
    plan.model.pose.roll_rad = aim_error();
    plan.model.angles_rad = draw_angles(options);
    plan.exposures = draw_exposures(options);

    if (options.distance) {
        place_camera(plan, options, *options.distance);
        return plan;
    }
    double near = 0, far = kMaxDistance;
    place_camera(plan, options, far);
    if (!are_visible(plan, shown)) {
        return Error{"camera: no distance up to 1000 shows the whole turntable; use a shorter focal length"};
    }
    for (int i = 0; i < 60; ++i) {
        const double middle = (near + far) / 2;
        place_camera(plan, options, middle);
        (are_visible(plan, shown) ? far : near) = middle;
    }
    place_camera(plan, options, far);
    return plan;
}

Camera pinhole_camera(const SessionPlan& plan, std::size_t view) {
    return object_camera(plan.model, view, plan.distance, -plan.camera_height / plan.distance);
}

RayImage lens_rays(const SessionPlan& plan, std::size_t view) {
    const Camera camera = pinhole_camera(plan, view);
    return {camera.width, camera.height, camera.centre(), camera.forward(),
            [lens = plan.model.lens, camera](double x, double y) {
                // plan_session() has checked that the distortion is invertible at the corners, hence everywhere.
                const auto direction = undistorted(lens, {x, y});
                return direction ? camera.forward() + camera.right() * direction->x - camera.up() * direction->y
                                 : camera.ray(x, y);
            }};
}

}  // namespace rs::capture
