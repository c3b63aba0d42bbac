#include "capture/photos/rig/nominal_rig.hpp"

#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <cmath>

namespace rs::capture {

double distance_for_unit_radius(double extent_px, double fl_px) {
    RS_CHECK(extent_px > 0 && fl_px > 0);
    return std::hypot(extent_px, fl_px) / extent_px;
}

Rig make_nominal_rig(const NominalRigOptions& options, const TurnOutline::Box& visible) {
    RS_CHECK(options.views > 0 && options.width > 0 && options.height > 0 && !visible.empty());
    const double fov_rad = radians(options.fov_deg);
    const double fl_px = options.width / (2 * std::tan(fov_rad / 2));
    const double extent_px = std::max(options.axis_x_px - visible.left, visible.right - options.axis_x_px);
    const double distance = distance_for_unit_radius(extent_px, fl_px);
    const double sense = options.turning == Turning::kClockwise ? 1 : -1;

    Rig rig;
    rig.object_radius = 1;
    for (int i = 0; i < options.views; ++i) {
        const double angle_rad = sense * i * radians(options.step_deg);
        RigView view;
        view.camera = look_at_camera({distance * std::sin(angle_rad), 0, distance * std::cos(angle_rad)}, {0, 0, 0},
                                     fov_rad, options.width, options.height);
        view.camera.cx = options.axis_x_px;
        view.camera.cy = (visible.top + visible.bottom) / 2.0;
        rig.views.push_back(std::move(view));
    }
    return rig;
}

}  // namespace rs::capture
