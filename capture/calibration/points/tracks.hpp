#pragma once
// Points of the object followed around the turn: SIFT features on object pixels, matched between near views, chained.
//
// Stands before the bundle. Nothing here knows the rig; wrong matches that agree with some epipolar geometry of their
// pair are left for the bundle to find.

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

// One photograph as calibration looks at it. All images of a turn have one size.
struct CalibrationImage {
    Image<std::uint8_t> grey;   // sRGB luma
    Image<std::uint8_t> alpha;  // of the object; same size
};

// What calibration is given of a turn.
struct TurnImages {
    std::vector<CalibrationImage> images;  // [view], in the order they were taken
    std::vector<std::string> names;        // [view], as messages call them
    int reduction = 1;                     // of the photographs' sides
    int width = 0;                         // of the photographs, px
    int height = 0;
};

// `image` (straight alpha) with both sides divided by `reduction` >= 1, averaged.
CalibrationImage calibration_image(ConstImageView<Rgba8> image, int reduction);

struct Observation {
    int view = 0;
    glm::dvec2 p{0.0};       // px, pixel centres at +0.5
    glm::dmat2 weight{1.0};  // the adjustment takes weight * residual; residuals themselves are always in px
};
struct Track {
    std::vector<Observation> seen;  // by ascending view, one per view, at least two
};

struct PairOfViews {
    int first = 0;
    int second = 0;
    int matches = 0;         // that agree with one epipolar geometry
    double motion_x_px = 0;  // median motion of the matches from first to second
    double motion_y_px = 0;
    double spread_x_px = 0;  // mean absolute motion
    double spread_y_px = 0;
};

struct FollowedPoints {
    std::vector<Track> tracks;  // with three views and more
    std::vector<int> features;  // [view]
    std::vector<PairOfViews> pairs;
};

struct FollowOptions {
    int most_features = 1500;    // per view
    int farthest_neighbour = 4;  // views i and i + 1 .. this are matched, around the end of the turn too
    int rim_px = 4;              // nearer to the object's outline nothing is looked for: backdrop shines in there
};

// Holds the features of all views. Works side by side; results do not depend on the number of threads.
class PointFollower {
public:
    // `turn` reduced by `reduction`; everything below is in px of the photographs. One step of `progress` per view.
    // Fails only where OpenCV does.
    static Result<PointFollower> look_at(std::span<const CalibrationImage> turn, int reduction,
                                         const FollowOptions& options, Progress* progress);
    PointFollower(PointFollower&& other) noexcept;
    ~PointFollower();

    // Knowing nothing: matches that pass Lowe's test and agree with some epipolar geometry of their two views. One step
    // of `progress` per view.
    [[nodiscard]] Result<FollowedPoints> follow(Progress* progress) const;

    // Knowing roughly how the object turns and that it stays within `radius` of the axis (units of the model): of the
    // features that lie within band_px of where a point can appear, the most alike. More and longer tracks, also on
    // patterns that repeat.
    [[nodiscard]] Result<std::vector<Track>> follow_guided(const TurntableModel& model, double radius,
                                                           double band_px) const;

private:
    struct State;
    explicit PointFollower(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace rs::capture
