#include "capture/photos/rig/found_rig.hpp"

#include "capture/calibration/silhouettes/turn_diagnosis.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/printable.hpp"

#include <cmath>
#include <functional>
#include <utility>

namespace rs::capture {
namespace {

double sense(const NominalTurn& nominal) {
    return nominal.turning == Turning::kCounterClockwise ? 1 : -1;
}

// Converts the pixel values of the request from the photos as displayed to the working size of the folder.
RigRequest in_image_px(RigRequest given, const PhotoFolder& folder) {
    KnownInputs& known = given.known.known;
    if (known.f_px) *known.f_px /= folder.reduction;
    if (known.principal_point) known.principal_point = folder.in_image(*known.principal_point);
    if (given.axis_x_px) given.axis_x_px = folder.in_image({*given.axis_x_px, 0}).x;
    return given;
}

Result<KnownInputs> known_inputs(const RigRequest& request, const std::function<const NominalTurn&()>& nominal,
                                 const PhotoFolder& folder) {
    Result<KnownInputs> known = known_inputs_of(request.known, file_names(folder));
    if (!known) return known;
    if (request.fov_deg) {
        known->f_px = 0.5 * folder.shown_width / folder.reduction / std::tan(0.5 * radians(*request.fov_deg));
    }
    if (request.turning) known->counter_clockwise = *request.turning == Turning::kCounterClockwise;
    if (request.degrees_per_view) known->step_rad = sense(nominal()) * radians(*request.degrees_per_view);
    return known;
}

TurntableModel nominal_model(const KnownInputs& known, const NominalTurn& nominal, const PhotoFolder& folder) {
    const double width = folder.width;
    const double assumed_f_px = 0.5 * width / std::tan(0.5 * radians(kNominalFieldOfView_deg));
    TurntableModel model;
    model.lens =
        apply_known(Lens{folder.width, folder.height, assumed_f_px, 0.5 * width, 0.5 * folder.height, 0, 0}, known);
    model.pose.pan_rad = std::atan((model.lens.cx - nominal.axis_x_px) / model.lens.f_px);
    for (std::size_t i = 0; i < folder.photos.size(); ++i) {
        model.angles_rad.push_back(sense(nominal) * static_cast<double>(i) * radians(nominal.step_deg));
    }
    return model;
}

void add_notes(FoundRig& rig, const std::vector<std::string>& notes) {
    rig.notes.insert(rig.notes.end(), notes.begin(), notes.end());
}

// Excludes photos taken at the angle of another photo. They add no new view, only an angle at which two images
// disagree.
void leave_out_repeats(FoundRig& rig, const PhotoFolder& folder) {
    const std::vector<std::string> names = file_names(folder);
    for (const int view : repeated_views(rig.calibration.calibration->model.angles_rad)) {
        rig.left_out.push_back(names[static_cast<std::size_t>(view)]);
    }
    if (rig.left_out.empty()) return;
    rig.notes.push_back(listed(rig.left_out, 1) + (rig.left_out.size() > 1
                                                       ? " repeat other images and are left out of the set"
                                                       : " repeats another image and is left out of the set"));
}

void use_nominal_rig(FoundRig& rig, const KnownInputs& given) {
    add_notes(rig, rig.nominal.notes);
    if (given.f_px || given.pose || given.angles_rad) {
        rig.notes.emplace_back(
            "a nominal rig ignores the values given by --known; --fov, --degrees-per-view and --axis-x set its "
            "values");
    }
    rig.method = CalibrationMethod::kNominal;
    rig.step_deg = rig.nominal.step_deg;
    rig.turning = rig.nominal.turning;
}

void take_calibrated(FoundRig& rig, const PhotoFolder& folder) {
    const Calibration& calibration = *rig.calibration.calibration;
    rig.method = calibration.method;
    rig.step_deg = std::abs(degrees(calibration.step_rad));
    rig.turning = calibration.step_rad > 0 ? Turning::kCounterClockwise : Turning::kClockwise;
    add_notes(rig, calibration.warnings);
    leave_out_repeats(rig, folder);
}

}  // namespace

Result<FoundRig> find_rig(const RigRequest& given, const PhotoFolder& folder, const SegmentedTurn& turn,
                          const ForegroundCache& foregrounds, Progress* progress) {
    const RigRequest request = in_image_px(given, folder);
    FoundRig rig;
    rig.nominal = find_nominal_turn(request, folder, turn);
    // Evaluated on demand: calibration by object points or a board yields the direction of rotation itself.
    const auto nominal = [&]() -> const NominalTurn& {
        if (rig.nominal.turning_from.empty()) estimate_turning(request, folder, turn, rig.nominal);
        return rig.nominal;
    };
    RS_ASSIGN_OR_RETURN(const KnownInputs known, known_inputs(request, nominal, folder));
    RS_ASSIGN_OR_RETURN(PhotoCalibration calibration,
                        calibrate_photos(folder, foregrounds,
                                         {request.calibration, known, request.board,
                                          [&] { return nominal_model(known, nominal(), folder); }},
                                         progress));
    rig.calibration = std::move(calibration);
    add_notes(rig, rig.calibration.notes);
    if (rig.calibration.calibration) {
        take_calibrated(rig, folder);
    } else {
        nominal();
        use_nominal_rig(rig, request.known.known);
    }
    return rig;
}

}  // namespace rs::capture
