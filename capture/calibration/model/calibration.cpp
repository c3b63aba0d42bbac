#include "capture/calibration/model/calibration.hpp"

namespace rs::capture {

std::string to_string(CalibrationMethod method) {
    switch (method) {
        case CalibrationMethod::kBoard:
            return "board";
        case CalibrationMethod::kGiven:
            return "given";
        case CalibrationMethod::kTracks:
            return "tracks";
        case CalibrationMethod::kSilhouettes:
            return "silhouettes";
        case CalibrationMethod::kNominal:
            return "nominal";
    }
    return "nominal";
}

Lens apply_known(Lens lens, const KnownInputs& known) {
    lens.f_px = known.f_px.value_or(lens.f_px);
    if (known.principal_point) {
        lens.cx = known.principal_point->x;
        lens.cy = known.principal_point->y;
    }
    if (known.distortion) {
        lens.k1 = known.distortion->x;
        lens.k2 = known.distortion->y;
    }
    return lens;
}

TurntableModel apply_known(TurntableModel model, const KnownInputs& known) {
    model.lens = apply_known(model.lens, known);
    model.pose = known.pose.value_or(model.pose);
    for (std::size_t i = 0; i < model.angles_rad.size() && known.step_rad; ++i) {
        model.angles_rad[i] = static_cast<double>(i) * *known.step_rad;
    }
    if (known.angles_rad) model.angles_rad = *known.angles_rad;
    return model;
}

}  // namespace rs::capture
