#include "capture/photos/rig/nominal_rig.hpp"

#include "capture/photos/rig/turning.hpp"
#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace rs::capture {

std::string to_string(Turning turning) {
    return turning == Turning::kClockwise ? "clockwise" : "counter-clockwise";
}

double distance_for_unit_radius(double extent_px, double fl_px) {
    RS_CHECK(extent_px > 0 && fl_px > 0);
    return std::hypot(extent_px, fl_px) / extent_px;
}

Rig make_nominal_rig(const NominalRigOptions& options, const TurnSilhouette::Box& visible) {
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

namespace {

constexpr double kDoubtfulSpread = 0.01;  // fraction of the image width

void find_axis(const NominalTurnRequest& request, const PhotoFolder& folder, const SegmentedTurn& turn, bool closed,
               NominalTurn& found) {
    found.axis_x_px = folder.width / 2.0;
    found.axis_from = "image middle";
    if (request.axis_x_px) {
        found.axis_x_px = *request.axis_x_px;
        found.axis_from = "given";
        return;
    }
    const auto axis = turn.silhouette.axis();
    if (!closed || !axis) {
        found.notes.push_back(std::string("the axis cannot be found ") +
                              (closed ? "(the object reaches the image's sides)" : "from less than a full turn") +
                              "; the image centre is used, --axis-x PX sets it");
        return;
    }
    found.axis_x_px = axis->x_px;
    found.axis_spread_px = axis->spread_px;
    found.axis_from = "silhouettes";
    if (axis->spread_px > kDoubtfulSpread * folder.width) {
        found.notes.push_back("the axis column is uncertain: the rows differ by " +
                              std::to_string(std::lround(axis->spread_px)) +
                              " px (camera not level, or steps uneven); --axis-x PX sets it");
    }
}

// True if the last view is one step before the first.
bool is_closed(const NominalTurn& found, const PhotoFolder& folder) {
    const auto views = static_cast<double>(folder.photos.size());
    return std::abs(found.step_deg * views - 360) < 1.5 * found.step_deg && views >= 4;
}

// Horizontal field of view by the EXIF focal length, nullopt outside 1..120 degrees. A cropped photo has a smaller one,
// so calibration does not use it.
std::optional<double> stated_field_of_view_deg(const PhotoFolder& folder) {
    constexpr double kFilmDiagonal_mm = 43.27;
    if (folder.focal_35mm == 0) return std::nullopt;
    const double share = folder.width / std::hypot(folder.width, folder.height);
    const double fov_deg = degrees(2 * std::atan(0.5 * kFilmDiagonal_mm * share / folder.focal_35mm));
    if (fov_deg < 1 || fov_deg > 120) return std::nullopt;
    return fov_deg;
}

}  // namespace

NominalTurn find_nominal_turn(const NominalTurnRequest& request, const PhotoFolder& folder, const SegmentedTurn& turn) {
    const auto views = static_cast<double>(folder.photos.size());
    NominalTurn found;
    const std::optional<double> stated = stated_field_of_view_deg(folder);
    found.fov_deg = request.fov_deg.value_or(stated.value_or(kNominalFieldOfView_deg));
    found.fov_from = request.fov_deg ? "given" : stated ? "camera" : "assumed";
    found.step_deg = request.degrees_per_view.value_or(360.0 / views);
    find_axis(request, folder, turn, is_closed(found, folder), found);
    return found;
}

void estimate_turning(const NominalTurnRequest& request, const PhotoFolder& folder, const SegmentedTurn& turn,
                      NominalTurn& found) {
    found.turning_from = "assumed";
    if (request.turning) {
        found.turning = *request.turning;
        found.turning_from = "given";
        return;
    }
    const double scale = static_cast<double>(turn.small.front().width()) / folder.width;
    const TurnSilhouette::Box box = turn.silhouette.visible();
    const double extent_px = std::max(found.axis_x_px - box.left, box.right - found.axis_x_px);
    const TurningEvidence evidence = find_turning(turn.small, found.axis_x_px * scale, extent_px * scale,
                                                  radians(found.step_deg), is_closed(found, folder));
    if (evidence.turning) {
        found.turning = *evidence.turning;
        found.turning_from = "pictures";
    } else {
        found.notes.push_back(
            "the direction of rotation is not clear from the images; clockwise as seen from above is "
            "assumed, --counter-clockwise sets the other");
    }
}

}  // namespace rs::capture
