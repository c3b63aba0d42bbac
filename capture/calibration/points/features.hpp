#pragma once
// SIFT features on the object's pixels of every view. Only for .cpp files of this folder: no header that others include
// may need OpenCV.

#include "capture/calibration/points/tracks.hpp"
#include "rayspace/base/progress.hpp"

#include <opencv2/core.hpp>

#include <functional>
#include <span>
#include <vector>

namespace rs::capture {

struct ViewFeatures {
    std::vector<glm::dvec2> positions;  // px of the pictures given, centres at +0.5
    cv::Mat descriptors;                // one row each, square roots of L1-normalised SIFT: unit vectors
};

// [view]. Works side by side, the same on any number of threads; one step of `progress` per view. Throws cv::Exception.
std::vector<ViewFeatures> find_features(std::span<const CalibrationPicture> turn, const FollowOptions& options,
                                        Progress* progress);

struct FeatureMatch {
    int first = 0;       // feature of the pair's first view
    int second = 0;      // ... of its second
    float likeness = 0;  // product of the descriptors, 1 = the same
};

// Which pairs of features may be the same point; everything may where it is empty.
using MayMatch = std::function<bool(const glm::dvec2& in_first, const glm::dvec2& in_second)>;

// Mutual best matches whose best distance is below `ratio` times the second best (Lowe's test).
std::vector<FeatureMatch> alike(const ViewFeatures& first, const ViewFeatures& second, double ratio,
                                const MayMatch& may_match = {});

// Matches chained to tracks of three views and more, the most alike first; a match that would bring two features of one
// view together is left out.
std::vector<Track> chained(std::span<const ViewFeatures> views, std::span<const PairOfViews> pairs,
                           std::span<const std::vector<FeatureMatch>> matches);

}  // namespace rs::capture
