#pragma once
/// \file
/// Bundle adjustment of several turns of one object, over the points that two or more turns share. The calibration of
/// each turn is a prior with its stated deviations. The placements are free: those of upright turns about the common
/// axis, those of other turns in all seven numbers.

#include "capture/calibration/model/calibration.hpp"
#include "capture/turns/turn_placement.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace rs::capture {

struct JointObservation {
    std::size_t turn = 0;
    std::size_t view = 0;
    glm::dvec2 p{0.0};  ///< px of the turn's photos
};

struct JointTrack {
    glm::dvec3 point{0.0};  ///< common frame
    std::vector<JointObservation> seen;
};

struct JointBundle {
    std::vector<PlacedTurn> turns;
    std::vector<ModelDeviations> deviations;  ///< [turn] of the single calibrations
    std::vector<JointTrack> tracks;
};

/// Residual statistics of one turn.
struct JointFit {
    std::size_t observations = 0;
    double rms_px = 0;
};

/// Minimizes reprojection errors and priors; drops outliers between rounds. The placement of the turn `reference`
/// stays. Returns the fit of each turn. Error: Ceres fails.
Result<std::vector<JointFit>> adjust_jointly(JointBundle& bundle, std::size_t reference);

}  // namespace rs::capture
