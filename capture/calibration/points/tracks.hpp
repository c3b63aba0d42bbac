#pragma once
// Tracks object points around the turn: SIFT features on object pixels, matched between nearby views and linked.
//
// Runs before the bundle and does not use the rig; wrong matches that are consistent with the epipolar geometry of
// their pair are left for the bundle to reject.

#include "capture/calibration/model/turntable_model.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rs::capture {

/// One photo prepared for calibration. All images of a turn have one size.
struct CalibrationImage {
    Image<std::uint8_t> grey;   // sRGB luma
    Image<std::uint8_t> alpha;  // of the object; same size
};

/// Input of calibration for one turn.
struct TurnImages {
    std::vector<CalibrationImage> images;  // [view], in the order they were taken
    std::vector<std::string> names;        // [view], used in messages
    int reduction = 1;                     // factor by which the photos' sides were reduced
    int width = 0;                         // of the photos, px
    int height = 0;                        // of the photos, px
};

/// `image` (straight alpha) with both sides divided by `reduction` >= 1 by averaging.
CalibrationImage calibration_image(ConstImageView<Rgba8> image, int reduction);

struct Observation {
    int view = 0;
    glm::dvec2 p{0.0};       // px, pixel centres at +0.5
    glm::dmat2 weight{1.0};  // the adjustment uses weight * residual; residuals themselves are always in px
};
struct Track {
    std::vector<Observation> seen;  // in ascending order of views, one per view, at least two
};

struct MatchedPair {
    int first = 0;
    int second = 0;
    int matches = 0;         // consistent with one epipolar geometry
    double motion_x_px = 0;  // median motion of the matches from first to second
    double motion_y_px = 0;
    double spread_x_px = 0;  // mean absolute motion
    double spread_y_px = 0;
};

struct TrackedPoints {
    std::vector<Track> tracks;  // of at least three views
    std::vector<int> features;  // [view]
    std::vector<MatchedPair> pairs;
};

struct TrackingOptions {
    int max_features = 1500;    // per view
    int max_view_distance = 4;  // views i and i + 1 .. this are matched, also across the end of the turn
    int margin_px =
        4;  // distance from the silhouette within which features are ignored: the backdrop shows through there
};

/// Holds the features of all views. Runs in parallel; results do not depend on the number of threads.
class PointTracker {
public:
    /// Detects the features. `turn` is reduced by `reduction`; all other positions are in px of the photos. One step of
    /// `progress` per view. Fails only if OpenCV does.
    static Result<PointTracker> detect(std::span<const CalibrationImage> turn, int reduction,
                                       const TrackingOptions& options, Progress* progress);
    PointTracker(PointTracker&& other) noexcept;
    ~PointTracker();

    /// Matching without a model: matches that pass Lowe's ratio test and are consistent with the epipolar geometry of
    /// their two views. One step of `progress` per view.
    [[nodiscard]] Result<TrackedPoints> track(Progress* progress) const;

    /// Guided matching with an approximate model of a turn of an object within `radius` of the axis (units of the
    /// model): the most similar of the features within band_px of where a point can appear. Gives more and longer
    /// tracks, also on repetitive patterns.
    [[nodiscard]] Result<std::vector<Track>> track_guided(const TurntableModel& model, double radius,
                                                          double band_px) const;

    /// Descriptor of the feature at an observation of a track, kDescriptorNumbers integers (descriptor_products.hpp).
    [[nodiscard]] std::span<const std::int16_t> descriptor_of(const Observation& seen) const;

private:
    struct State;
    explicit PointTracker(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace rs::capture
