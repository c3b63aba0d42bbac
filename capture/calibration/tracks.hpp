#pragma once
// Points of the object followed around the turn: SIFT features on object pixels, matched between near views, chained.
//
// Stands before the bundle. Nothing here knows the rig; wrong matches that agree with some epipolar geometry of their
// pair are left for the bundle to find.

#include "rayspace/image.hpp"
#include "rayspace/progress.hpp"
#include "rayspace/result.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rs::capture {

// One photograph as calibration looks at it. All pictures of a turn have one size.
struct CalibrationPicture {
    Image<std::uint8_t> grey;   // sRGB luma
    Image<std::uint8_t> alpha;  // of the object; same size
};

// What calibration is given of a turn.
struct TurnPictures {
    std::vector<CalibrationPicture> pictures;  // [view], in the order they were taken
    std::vector<std::string> names;            // [view], as messages call them
    int reduction = 1;                         // of the photographs' sides
    int width = 0;                             // of the photographs, px
    int height = 0;
};

// `picture` (straight alpha) with both sides divided by `reduction` >= 1, averaged.
CalibrationPicture calibration_picture(ConstImageView<Rgba8> picture, int reduction);

struct Observation {
    int view = 0;
    glm::dvec2 p{0.0};  // px, pixel centres at +0.5
    double weight = 1;  // of its residual in the adjustment; residuals themselves are always in px
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

// Works side by side; the result does not depend on the number of threads. Advances `progress` by two steps a view.
// Fails only where OpenCV does.
Result<FollowedPoints> follow_points(std::span<const CalibrationPicture> turn, const FollowOptions& options,
                                     Progress* progress);

}  // namespace rs::capture
