#pragma once
// Single-axis bundle adjustment: the turntable model and the points of the object that together explain all
// observations best. Stands between tracks and track_calibration.
//
// Unknown are one camera and one number per view, whatever the number of views, so little is left to drift: see
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

// Call before ceres::Solve. Thread-safe; affects the whole process.
void silence_ceres();

enum class AngleFreedom {
    kHeld,
    kCommonStep,  // view i stands at i times one step
    kEach,        // all but the first view's
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

// All that is not known is free, but for the lens' distortion, which observations must have earned.
BundleFreedom freedom_beside(const KnownInputs& known);

struct BundleOptions {
    BundleFreedom free;
    double loss_px = 1;  // Cauchy: weighted residuals of this length count half
    int most_iterations = 50;
    double enough = 1e-7;  // of the cost: a round that changes it by less is the last
};

// What lenses are like, given to the adjustment as weak observations so that what the images do not show stays at its
// ordinary value: one standard deviation each.
inline constexpr double kPriorK1 = 0.3;
inline constexpr double kPriorK2 = 0.1;
inline constexpr double kPriorPrincipalPoint = 0.03;  // of the image's width, from its middle

// tracks[i] is explained by points[i], in the frame of turntable_model.hpp at angle 0.
struct Bundle {
    TurntableModel model;
    std::vector<Track> tracks;
    std::vector<glm::dvec3> points;
};

// The point nearest to all rays of a track, improved to the least reprojection error. Nothing where the rays are nearly
// parallel, the point is not before the camera in every view, or it lies farther from the axis than the camera.
std::optional<glm::dvec3> triangulated(const TurntableModel& model, const Track& track);

// Where the model expects a point in a view, px; nothing where it is not before the camera.
std::optional<glm::dvec2> projected(const TurntableModel& model, const glm::dvec3& point, int view);

// Residual vector of one observation, px; nothing where the point is not before the camera.
std::optional<glm::dvec2> residual(const TurntableModel& model, const glm::dvec3& point, const Observation& seen);
std::optional<glm::dvec2> residual(const TurnProjection& turn, const glm::dvec3& point, const Observation& seen);

// Improves model and points in place. The value is the mean robust cost per observation in px^2 (loss_px^2 log(1 + r^2
// / loss_px^2)); nothing where Ceres cannot evaluate the start. Deterministic; uses one thread, so several bundles may
// be adjusted at once.
std::optional<double> adjust(Bundle& bundle, const BundleOptions& options);

// Tracks triangulated anew; those that cannot be are dropped.
Bundle make_bundle(const TurntableModel& model, std::span<const Track> tracks);

// The same where part of a track's observations may be wrong matches: the point is that of the pair of rays with which
// most others agree within limit_px, and only those observations are kept; at least three.
Bundle make_agreeing_bundle(const TurntableModel& model, std::span<const Track> tracks, double limit_px);

// Drops observations whose weighted residual is longer than limit_px, then tracks with fewer than three left. The
// number of observations dropped.
int drop_outliers(Bundle& bundle, double limit_px);

std::vector<int> observations_per_view(std::span<const Track> tracks, std::size_t views);
int observation_count(const Bundle& bundle);
double rms_px(const Bundle& bundle);
// A robust standard deviation of weighted residual components: 1.4826 times the median of their absolute values.
double robust_deviation_px(const Bundle& bundle);

}  // namespace rs::capture
