#pragma once
// SIFT features on the object's pixels of every view, and which of them are alike.

#include "capture/calibration/points/descriptor_products.hpp"
#include "capture/calibration/points/tracks.hpp"
#include "rayspace/base/progress.hpp"

#include <glm/glm.hpp>

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace rs::capture {

struct ViewFeatures {
    std::vector<glm::dvec2> positions;  // px of the images given, centres at +0.5
    Descriptors descriptors;            // square roots of L1-normalised SIFT, of length kDescriptorUnit
    PackedDescriptors packed{{}};       // the same
};

// [view]. Works side by side, the same on any number of threads; one step of `progress` per view. Throws cv::Exception.
std::vector<ViewFeatures> find_features(std::span<const CalibrationImage> turn, const FollowOptions& options,
                                        Progress* progress);

struct FeatureMatch {
    int first = 0;       // feature of the pair's first view
    int second = 0;      // ... of its second
    float likeness = 0;  // product of the descriptors: the greater the more alike
};

// Mutual best matches whose best distance is below `ratio` times the second best (Lowe's test).
std::vector<FeatureMatch> alike(const ViewFeatures& first, const ViewFeatures& second, double ratio);

// A straight piece of an image.
struct Segment {
    glm::dvec2 from{0.0};
    glm::dvec2 to{0.0};
    [[nodiscard]] double distance(const glm::dvec2& p) const;
};

// The same among the pairs that lie within `band_px` of where the first's point may appear in the second view.
using MayAppear = std::function<std::optional<Segment>(const glm::dvec2& in_first)>;
std::vector<FeatureMatch> match_guided(const ViewFeatures& first, const ViewFeatures& second, double ratio,
                                       const MayAppear& may_appear, double band_px);

// Matches chained to tracks of three views and more, the most alike first; a match that would bring two features of one
// view together is left out.
std::vector<Track> chained(std::span<const ViewFeatures> views, std::span<const PairOfViews> pairs,
                           std::span<const std::vector<FeatureMatch>> matches);

}  // namespace rs::capture
