#pragma once
// Result of calibrating a turn with any method: the model, the accuracy of each number, and warnings for the
// photographer.

#include "capture/calibration/model/turntable_model.hpp"

#include <glm/glm.hpp>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace rs::capture {

/// From the most to the least accurate.
enum class CalibrationMethod {
    kBoard,        // a printed board on the turntable
    kGiven,        // lens, pose and angles are all known
    kTracks,       // object points tracked around the turn
    kSilhouettes,  // consistency of all silhouettes; for bodies of revolution the steps are assumed
    kNominal,      // equal steps, an assumed lens, a level camera
};
std::string to_string(CalibrationMethod method);  // "board", "given", "tracks", "silhouettes", "nominal"

/// One standard deviation each, in the unit of the number; 0 if the number was given and held constant, infinity if its
/// error is unknown.
struct ModelDeviations {
    double f_px = std::numeric_limits<double>::infinity();
    double cx = std::numeric_limits<double>::infinity();
    double cy = std::numeric_limits<double>::infinity();
    double k1 = std::numeric_limits<double>::infinity();
    double k2 = std::numeric_limits<double>::infinity();
    double axis_direction_rad =
        std::numeric_limits<double>::infinity();  // of tilt and roll together (root of the sum of squares)
    double tilt_rad = std::numeric_limits<double>::infinity();
    double roll_rad = std::numeric_limits<double>::infinity();
    double axis_position_px =
        std::numeric_limits<double>::infinity();  // of the axis' column (its row for a sideways axis)
    std::vector<double> angles_rad;               // [view]; relative to the mean of all views
};

/// Fit of one view.
struct ViewFit {
    int observations = 0;
    double rms_px = 0;  // root mean square of the residual lengths; 0 without observations
};

/// Shift and scale of one image of a turn: shops crop and scale the images of a spin individually, so that the object
/// fills each and is centred. A point p (px) in the image of the fixed camera appears at middle + scale * (p - middle)
/// + shift_px, where middle is the centre of the frame, which both images share.
struct ImagePlacement {
    glm::dvec2 shift_px{0.0};
    double scale = 1;

    [[nodiscard]] glm::dvec2 seen(const glm::dvec2& p, const glm::dvec2& middle) const {
        return middle + scale * (p - middle) + shift_px;
    }
    [[nodiscard]] glm::dvec2 undone(const glm::dvec2& p, const glm::dvec2& middle) const {
        return middle + (p - middle - shift_px) / scale;
    }
    /// Composition: the placement `inner` followed by this one.
    [[nodiscard]] ImagePlacement of(const ImagePlacement& inner) const {
        return {shift_px + scale * inner.shift_px, scale * inner.scale};
    }
};

struct Calibration {
    CalibrationMethod method = CalibrationMethod::kNominal;
    TurntableModel model;
    /// [view]; empty unless the photos were shifted and scaled individually. The model, points and residuals refer to
    /// the photos with this undone.
    std::vector<ImagePlacement> places;
    ModelDeviations deviations;
    int points = 0;
    int observations = 0;
    double rms_px = 0;                      // root mean square of the residual lengths
    std::optional<double> held_out_rms_px;  // the same for held-out tracks without outliers
    std::vector<ViewFit> views;             // [view]
    double step_rad = 0;                    // median from view to view, signed
    std::vector<std::string> warnings;      // one line each, something that a photographer can act on
};

/// Known values: every number that is set is held constant, not estimated.
struct KnownInputs {
    std::optional<double> f_px;
    std::optional<glm::dvec2> principal_point;  // default: the image centre, unless estimate_principal_point
    std::optional<glm::dvec2> distortion;       // k1, k2
    std::optional<double> step_rad;             // from view to view, signed as in turntable_model.hpp
    std::optional<std::vector<double>> angles_rad;
    std::optional<bool> counter_clockwise;  // seen from above, i.e. positive angles
    std::optional<CameraPose> pose;
    bool estimate_principal_point = false;
    bool equal_steps = false;  // one common step for all views
};

/// Replaces assumed numbers by known ones. `model` has an angle for each view.
Lens apply_known(Lens lens, const KnownInputs& known);
TurntableModel apply_known(TurntableModel model, const KnownInputs& known);

}  // namespace rs::capture
