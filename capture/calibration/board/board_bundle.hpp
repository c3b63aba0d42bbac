#pragma once
// Bundle adjustment with a board: estimates camera, angles and board placement from all corners of all views.

#include "capture/calibration/board/board_initialization.hpp"
#include "capture/calibration/model/calibration.hpp"
#include "capture/calibration/points/bundle.hpp"

#include <span>
#include <vector>

namespace rs::capture {

/// One detected corner in one view.
struct BoardObservation {
    int view = 0;
    glm::dvec2 at_mm{0};  // board frame
    glm::dvec2 seen{0};   // px
};

struct BoardBundleOptions {
    BundleFreedom free;
    double noise_px = 0.3;  // standard deviation of a coordinate; the Huber loss is linear beyond 3 noise_px
    int max_iterations = 60;
};

/// Residual vector in px; nothing if the corner is behind the camera.
std::optional<glm::dvec2> residual(const BoardTurn& turn, const BoardObservation& seen);

/// Refines `turn` in place. Views without observations keep their angle; with kCommonStep view i is at i times the
/// angle of view 1. Returns the mean robust cost in noise_px^2, or nothing if Ceres cannot evaluate the start.
/// Deterministic, one thread.
std::optional<double> adjust(BoardTurn& turn, std::span<const BoardObservation> seen,
                             const BoardBundleOptions& options);

/// Standard deviations at the optimum of adjust(), from the covariance of all unknowns with noise_px as the
/// observations' deviation. All are infinite if the observations do not determine the unknowns.
ModelDeviations board_standard_deviations(const BoardTurn& turn, std::span<const BoardObservation> seen,
                                          const BoardBundleOptions& options);

}  // namespace rs::capture
