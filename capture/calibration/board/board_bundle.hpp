#pragma once
// Bundle adjustment with a board: camera, angles and where the board lies, from all corners of all views at once.

#include "capture/calibration/board/board_start.hpp"
#include "capture/calibration/model/calibration.hpp"
#include "capture/calibration/points/bundle.hpp"

#include <span>
#include <vector>

namespace rs::capture {

// One corner seen in one view.
struct BoardObservation {
    int view = 0;
    glm::dvec2 at_mm{0};  // board frame
    glm::dvec2 seen{0};   // px
};

struct BoardBundleOptions {
    BundleFreedom free;
    double noise_px = 0.3;  // of a coordinate; residuals beyond three of it count less (Huber)
    int most_iterations = 60;
};

// Residual vector, px; nothing where the corner is not before the camera.
std::optional<glm::dvec2> residual(const BoardTurn& turn, const BoardObservation& seen);

// Improves `turn` in place; views without observations keep their angle (kCommonStep: follow the step, view i at i
// steps of view 1's angle). The value is the mean robust cost in noise_px^2; nothing where Ceres cannot evaluate the
// start. Deterministic, one thread.
std::optional<double> adjust(BoardTurn& turn, std::span<const BoardObservation> seen,
                             const BoardBundleOptions& options);

// At the optimum of adjust(): the covariance of all unknowns together, with noise_px as the observations' deviation.
// All infinite where the observations do not determine the unknowns.
ModelDeviations board_deviations(const BoardTurn& turn, std::span<const BoardObservation> seen,
                                 const BoardBundleOptions& options);

}  // namespace rs::capture
