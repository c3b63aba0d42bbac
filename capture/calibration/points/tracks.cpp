#include "capture/calibration/points/tracks.hpp"

#include "capture/calibration/points/features.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace rs::capture {
namespace {

constexpr double kRatio = 0.8;            // Lowe's ratio: best distance / second best
constexpr double kGuidedRatio = 0.9;      // among the few candidates that the model allows
constexpr double kEpipolarBand_px = 1.5;  // at 1000 px of the longer side; proportional to it
constexpr int kFewestMatches = 12;        // pairs with fewer are ignored

// Inliers of one epipolar geometry (RANSAC with OpenCV's fixed seed).
std::vector<FeatureMatch> epipolar_inliers(const std::vector<FeatureMatch>& matches, const ViewFeatures& a,
                                           const ViewFeatures& b, double band_px) {
    if (static_cast<int>(matches.size()) < kFewestMatches) return {};
    std::vector<cv::Point2d> in_a, in_b;
    for (const FeatureMatch& match : matches) {
        const glm::dvec2 p = a.positions[static_cast<std::size_t>(match.first)];
        const glm::dvec2 q = b.positions[static_cast<std::size_t>(match.second)];
        in_a.emplace_back(p.x, p.y);
        in_b.emplace_back(q.x, q.y);
    }
    std::vector<std::uint8_t> good;
    const cv::Mat f = cv::findFundamentalMat(in_a, in_b, cv::FM_RANSAC, band_px, 0.999, 3000, good);
    std::vector<FeatureMatch> kept;
    if (f.empty()) return kept;
    for (std::size_t i = 0; i < matches.size(); ++i) {
        if (good[i] != 0) kept.push_back(matches[i]);
    }
    if (static_cast<int>(kept.size()) < kFewestMatches) kept.clear();
    return kept;
}

void measure_motion(const ViewFeatures& a, const ViewFeatures& b, const std::vector<FeatureMatch>& matches,
                    MatchedPair& pair) {
    pair.matches = static_cast<int>(matches.size());
    std::vector<double> dx, dy;
    for (const FeatureMatch& match : matches) {
        const glm::dvec2 motion =
            b.positions[static_cast<std::size_t>(match.second)] - a.positions[static_cast<std::size_t>(match.first)];
        dx.push_back(motion.x);
        dy.push_back(motion.y);
        pair.spread_x_px += std::abs(motion.x) / static_cast<double>(matches.size());
        pair.spread_y_px += std::abs(motion.y) / static_cast<double>(matches.size());
    }
    pair.motion_x_px = median(std::move(dx));
    pair.motion_y_px = median(std::move(dy));
}

// Each view paired with the next few, also across the end of the turn; no pair twice.
std::vector<MatchedPair> near_pairs(int count, int max_view_distance) {
    std::set<std::pair<int, int>> wanted;
    for (int i = 0; i < count; ++i) {
        for (int step = 1; step <= max_view_distance && step < count; ++step) {
            const int other = (i + step) % count;
            if (!wanted.contains({other, i})) wanted.insert({i, other});
        }
    }
    std::vector<MatchedPair> pairs;
    for (const auto& [first, second] : wanted) pairs.push_back({.first = first, .second = second});
    return pairs;
}

// Segment in the second view where a point seen at `p` in the first may appear: the projection of the part of its ray
// within the object's cylinder, nearly straight.
std::optional<Segment> epipolar_segment(const TurntableModel& model, int first, int second, const glm::dvec2& p,
                                        double radius) {
    const auto ray = table_ray(model.lens, model.pose, p);
    if (!ray) return std::nullopt;
    // (0, 0, 1) + s * ray meets the cylinder where (s ray.x)^2 + (1 + s ray.z)^2 = radius^2.
    const double a = ray->x * ray->x + ray->z * ray->z;
    const double under = ray->z * ray->z - a * (1 - radius * radius);
    if (!(under > 0) || !(a > 0)) return std::nullopt;
    const double turn =
        model.angles_rad[static_cast<std::size_t>(second)] - model.angles_rad[static_cast<std::size_t>(first)];
    Segment piece;
    for (const double sign : {-1.0, 1.0}) {
        const double s = (-ray->z + sign * std::sqrt(under)) / a;
        const auto end = project(model.lens, model.pose, turned(glm::dvec3(0, 0, 1) + s * *ray, turn));
        if (!end) return std::nullopt;
        (sign < 0 ? piece.from : piece.to) = *end;
    }
    return piece;
}

// Converts positions to px of the photos.
ViewFeatures scale_to_photo(ViewFeatures view, int reduction) {
    for (glm::dvec2& p : view.positions) p *= static_cast<double>(reduction);
    return view;
}

}  // namespace

CalibrationImage calibration_image(ConstImageView<Rgba8> image, int reduction) {
    RS_CHECK(reduction >= 1);
    const int width = std::max(1, image.width() / reduction);
    const int height = std::max(1, image.height() / reduction);
    CalibrationImage result{Image<std::uint8_t>(width, height), Image<std::uint8_t>(width, height)};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            int luma = 0, alpha = 0, count = 0;
            for (int dy = 0; dy < reduction && y * reduction + dy < image.height(); ++dy) {
                for (int dx = 0; dx < reduction && x * reduction + dx < image.width(); ++dx) {
                    const Rgba8 p = image(x * reduction + dx, y * reduction + dy);
                    luma += (77 * p.r + 150 * p.g + 29 * p.b + 128) / 256;
                    alpha += p.a;
                    ++count;
                }
            }
            result.grey(x, y) = static_cast<std::uint8_t>((luma + count / 2) / count);
            result.alpha(x, y) = static_cast<std::uint8_t>((alpha + count / 2) / count);
        }
    }
    return result;
}

struct PointTracker::State {
    std::vector<ViewFeatures> views;  // in px of the photos
    std::vector<MatchedPair> pairs;
    double band_px = 0;
};

PointTracker::PointTracker(std::unique_ptr<State> state) : state_(std::move(state)) {}
PointTracker::PointTracker(PointTracker&&) noexcept = default;
PointTracker::~PointTracker() = default;

Result<PointTracker> PointTracker::detect(std::span<const CalibrationImage> turn, int reduction,
                                          const TrackingOptions& options, Progress* progress) {
    auto state = std::make_unique<State>();
    if (turn.empty()) return PointTracker(std::move(state));
    const double longer = reduction * std::max(turn.front().grey.width(), turn.front().grey.height());
    state->band_px = kEpipolarBand_px * std::max(1.0, longer / 1000);
    state->pairs = near_pairs(static_cast<int>(turn.size()), options.max_view_distance);
    try {
        for (ViewFeatures& view : find_features(turn, options, progress)) {
            state->views.push_back(scale_to_photo(std::move(view), reduction));
        }
    } catch (const cv::Exception& escaped) {
        return Error{std::string("the images' features cannot be detected (OpenCV: ") + escaped.what() + ")"};
    }
    return PointTracker(std::move(state));
}

Result<TrackedPoints> PointTracker::track(Progress* progress) const {
    TrackedPoints found;
    found.pairs = state_->pairs;
    for (const ViewFeatures& view : state_->views) found.features.push_back(static_cast<int>(view.positions.size()));
    std::vector<std::vector<FeatureMatch>> matches(found.pairs.size());
    try {
        for_each_index(found.pairs.size(), [&](std::size_t i) {
            MatchedPair& pair = found.pairs[i];
            const ViewFeatures& a = state_->views[static_cast<std::size_t>(pair.first)];
            const ViewFeatures& b = state_->views[static_cast<std::size_t>(pair.second)];
            matches[i] = epipolar_inliers(match_features(a, b, kRatio), a, b, state_->band_px);
            measure_motion(a, b, matches[i], pair);
            const auto count = static_cast<int>(state_->views.size());
            if (progress != nullptr && pair.second == (pair.first + 1) % count) progress->advance();
        });
        found.tracks = build_tracks(state_->views, found.pairs, matches);
    } catch (const cv::Exception& escaped) {
        return Error{std::string("the images' features cannot be matched (OpenCV: ") + escaped.what() + ")"};
    }
    return found;
}

Result<std::vector<Track>> PointTracker::track_guided(const TurntableModel& model, double radius,
                                                      double band_px) const {
    std::vector<std::vector<FeatureMatch>> matches(state_->pairs.size());
    try {
        for_each_index(state_->pairs.size(), [&](std::size_t i) {
            const MatchedPair& pair = state_->pairs[i];
            const ViewFeatures& a = state_->views[static_cast<std::size_t>(pair.first)];
            const ViewFeatures& b = state_->views[static_cast<std::size_t>(pair.second)];
            const auto search_segment = [&](const glm::dvec2& p) {
                return epipolar_segment(model, pair.first, pair.second, p, radius);
            };
            matches[i] = match_guided(a, b, kGuidedRatio, search_segment, band_px);
        });
        return build_tracks(state_->views, state_->pairs, matches);
    } catch (const cv::Exception& escaped) {
        return Error{std::string("the images' features cannot be matched (OpenCV: ") + escaped.what() + ")"};
    }
}

std::span<const std::int16_t> PointTracker::descriptor_of(const Observation& seen) const {
    const ViewFeatures& view = state_->views[static_cast<std::size_t>(seen.view)];
    const auto at = std::ranges::find(view.positions, seen.p);
    RS_CHECK(at != view.positions.end());
    const auto feature = static_cast<std::size_t>(at - view.positions.begin());
    return std::span(view.descriptors).subspan(feature * kDescriptorNumbers, kDescriptorNumbers);
}

}  // namespace rs::capture
