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

}  // namespace rs::capture
