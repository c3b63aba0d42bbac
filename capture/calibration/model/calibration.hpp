#pragma once
// The outcome of calibrating a turn, whatever found it: the model, how sure each number is, and what a photographer
// should know.

#include "capture/calibration/model/image_place.hpp"
#include "capture/calibration/model/turntable_model.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace rs::capture {

// From the surest to the least sure.
enum class CalibrationMethod {
    kBoard,        // a printed board on the turntable
    kGiven,        // lens, pose and angles are all known
    kTracks,       // points of the object followed around the turn
    kSilhouettes,  // consistency of all outlines; of round bodies the steps are assumed
    kNominal,      // equal steps, an assumed lens, a level camera
};
std::string to_string(CalibrationMethod method);  // "board", "given", "tracks", "silhouettes", "nominal"

// One standard deviation each, in the unit of the number; 0 where the number was given and held, infinity where nothing
// says how far it is off.
struct ModelDeviations {
    double f_px = std::numeric_limits<double>::infinity();
    double cx = std::numeric_limits<double>::infinity();
    double cy = std::numeric_limits<double>::infinity();
    double k1 = std::numeric_limits<double>::infinity();
    double k2 = std::numeric_limits<double>::infinity();
    double axis_direction_rad = std::numeric_limits<double>::infinity();  // of tilt and roll together (their root sum)
    double tilt_rad = std::numeric_limits<double>::infinity();
    double roll_rad = std::numeric_limits<double>::infinity();
    double axis_position_px =
        std::numeric_limits<double>::infinity();  // of the axis' column (row where it lies sideways)
    std::vector<double> angles_rad;               // [view]; relative to the mean of all views
};

struct ViewFit {
    int observations = 0;
    double rms_px = 0;  // of residual vectors' lengths; 0 without observations
};

struct Calibration {
    CalibrationMethod method = CalibrationMethod::kNominal;
    TurntableModel model;
    // [view]; empty unless the photographs were moved and scaled one by one. The model, points and residuals are those
    // of the photographs put back.
    std::vector<ImagePlace> places;
    ModelDeviations deviations;
    int points = 0;
    int observations = 0;
    double rms_px = 0;                      // root mean square of the residual vectors' lengths
    std::optional<double> held_out_rms_px;  // the same of tracks that took no part, but for outliers
    std::vector<ViewFit> views;             // [view]
    double step_rad = 0;                    // median from view to view, signed
    std::vector<std::string> warnings;      // one line each, that a photographer can act on
};

// What is known beforehand and held: every number that is set is not estimated.
struct KnownInputs {
    std::optional<double> f_px;
    std::optional<glm::dvec2> principal_point;  // otherwise the image's middle, unless estimate_principal_point
    std::optional<glm::dvec2> distortion;       // k1, k2
    std::optional<double> step_rad;             // from view to view, signed as in turntable_model.hpp
    std::optional<std::vector<double>> angles_rad;
    std::optional<bool> counter_clockwise;  // seen from above, i.e. positive angles
    std::optional<CameraPose> pose;
    bool estimate_principal_point = false;
    bool equal_steps = false;  // one common step for all views
};

// What was assumed, with the numbers that are known in their place. `model` has an angle for each view.
Lens with_known(Lens lens, const KnownInputs& known);
TurntableModel with_known(TurntableModel model, const KnownInputs& known);

}  // namespace rs::capture
