#pragma once
// SIFT features on the object's pixels of every view, and their matching between views.

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
    std::vector<glm::dvec2> positions;  // px of the given images, centres at +0.5
    Descriptors descriptors;            // RootSIFT: square roots of L1-normalized SIFT, of length kDescriptorUnit
    PackedDescriptors packed{{}};       // the same descriptors, packed
};

/// Features of each view: result[view]. Runs in parallel, with equal results on any number of threads; one step of
/// `progress` per view. Throws cv::Exception.
std::vector<ViewFeatures> find_features(std::span<const CalibrationImage> turn, const TrackingOptions& options,
                                        Progress* progress);

struct FeatureMatch {
    int first = 0;         // feature of the pair's first view
    int second = 0;        // index in the second view
    float similarity = 0;  // product of the descriptors: larger is more similar
};

/// Mutual best matches whose best distance is below `ratio` times the second best (Lowe's ratio test).
std::vector<FeatureMatch> match_features(const ViewFeatures& first, const ViewFeatures& second, double ratio);

/// Line segment in an image.
struct Segment {
    glm::dvec2 from{0.0};
    glm::dvec2 to{0.0};
    [[nodiscard]] double distance(const glm::dvec2& p) const;
};

/// Guided matching: only features of the second view within `band_px` of the segment where the point may appear.
using SearchSegment = std::function<std::optional<Segment>(const glm::dvec2& in_first)>;
std::vector<FeatureMatch> match_guided(const ViewFeatures& first, const ViewFeatures& second, double ratio,
                                       const SearchSegment& search_segment, double band_px);

/// Links matches to tracks of at least three views, the most similar matches first; a match that would put two features
/// of one view into a track is skipped.
std::vector<Track> build_tracks(std::span<const ViewFeatures> views, std::span<const MatchedPair> pairs,
                                std::span<const std::vector<FeatureMatch>> matches);

}  // namespace rs::capture
