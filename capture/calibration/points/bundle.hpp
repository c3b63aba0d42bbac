#pragma once
// Single-axis bundle adjustment: estimates the turntable model and the object points that minimize the reprojection
// error of all observations. Runs between point tracking and track_calibration.
//
// The unknowns are one camera and one angle per view, whatever the number of views, which prevents drift: see
// Fitzgibbon, Cross and Zisserman, "Automatic 3D model construction for turn-table sequences" (1998), who first solved
// this geometry. The gauge is fixed by the model itself (camera at (0, 0, 1)) and by angle 0 of the first view.

#include "capture/calibration/model/calibration.hpp"
#include "capture/calibration/model/turn_projection.hpp"
#include "capture/calibration/model/turntable_model.hpp"
#include "capture/calibration/points/tracks.hpp"

#include <glm/glm.hpp>

#include <optional>
#include <span>
#include <vector>

namespace rs::capture {

// Libraries of this project do not print; Ceres does, through glog.

/// Call before ceres::Solve. Thread-safe; affects the whole process.
void silence_ceres();

enum class AngleFreedom {
    kConstant,
    kCommonStep,  // view i is at i times one step
    kEach,        // all but the first view's, which is 0
};

struct BundleFreedom {
    bool f = true;
    bool principal_point = false;
    bool k1 = false;
    bool k2 = false;
    bool pan = true;
    bool tilt = true;
    bool roll = true;
    AngleFreedom angles = AngleFreedom::kEach;
};

/// Frees all unknown numbers except the lens distortion, which is only freed once the observations support it.
BundleFreedom free_parameters_beside(const KnownInputs& known);

struct BundleOptions {
    BundleFreedom free;
    double loss_px = 1;  // Cauchy loss: weighted residuals of this length have weight 1/2
    int max_iterations = 50;
    double function_tolerance = 1e-7;  // function tolerance: relative change of the cost at which iteration stops
};

/// Priors of the lens parameters as weak observations, so that parameters that the images do not determine keep typical
/// values: one standard deviation each.
inline constexpr double kPriorK1 = 0.3;
inline constexpr double kPriorK2 = 0.1;
inline constexpr double kPriorPrincipalPoint = 0.03;  // relative to the image width, from the image centre

/// points[i] is the point of tracks[i], in the frame of turntable_model.hpp at angle 0.
struct Bundle {
    TurntableModel model;
    std::vector<Track> tracks;
    std::vector<glm::dvec3> points;
};

/// The point nearest to all rays of a track, refined to the least reprojection error. Nothing if the rays are nearly
/// parallel, the point is not in front of the camera in every view, or it is farther from the axis than the camera.
std::optional<glm::dvec3> triangulate(const TurntableModel& model, const Track& track);

/// Projection of a point into a view, px; nothing if it is not in front of the camera.
std::optional<glm::dvec2> project_point(const TurntableModel& model, const glm::dvec3& point, int view);

/// Residual vector of one observation, px; nothing if the point is not in front of the camera.
std::optional<glm::dvec2> residual(const TurntableModel& model, const glm::dvec3& point, const Observation& seen);
std::optional<glm::dvec2> residual(const TurnProjection& turn, const glm::dvec3& point, const Observation& seen);

/// Refines model and points in place. Returns the mean robust cost per observation in px^2 (loss_px^2 log(1 + r^2 /
/// loss_px^2)), or nothing if Ceres cannot evaluate the start. Deterministic; uses one thread, so several bundles may
/// be adjusted in parallel.
std::optional<double> adjust(Bundle& bundle, const BundleOptions& options);

/// Triangulates the tracks; those that cannot be triangulated are dropped.
Bundle make_bundle(const TurntableModel& model, std::span<const Track> tracks);

/// The same for tracks that may contain wrong matches: the point is triangulated from the pair of rays that has the
/// most inliers within limit_px, and only the inliers are kept; at least three.
Bundle make_robust_bundle(const TurntableModel& model, std::span<const Track> tracks, double limit_px);

/// Drops observations whose weighted residual is longer than limit_px, then tracks with fewer than three observations.
/// Returns the number of dropped observations.
int drop_outliers(Bundle& bundle, double limit_px);

std::vector<int> observations_per_view(std::span<const Track> tracks, std::size_t views);
int observation_count(const Bundle& bundle);
double rms_px(const Bundle& bundle);
/// Robust standard deviation of weighted residual components: 1.4826 times the median of their absolute values.
double robust_deviation_px(const Bundle& bundle);

/// Start of the bundle adjustment (start_search.cpp).
struct InitialModel {
    TurntableModel model;  // after bundles with one common step
    int agreeing = 0;      // observations within a few pixels of it
    int agreeing_opposite =
        0;  // the largest `agreeing` of models with the other direction; 0 if the direction was given
};

/// Tries equal steps with several focal lengths, tilts and both directions of turning. `tracks` in px of the photos.
/// Nothing if no start explains them.
std::optional<InitialModel> find_initial_model(std::span<const Track> tracks, std::span<const MatchedPair> pairs,
                                               int views, const Lens& middle, const KnownInputs& known);

}  // namespace rs::capture
