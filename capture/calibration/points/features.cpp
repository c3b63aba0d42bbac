#include "capture/calibration/points/features.hpp"

#include <tbb/parallel_for.h>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace rs::capture {
namespace {

// Finer than SIFT's usual 1.6: fur, leaves and thin glazes have twice the points, and alignment makes them exact.
constexpr double kFinestBlur_px = 1.2;

cv::Mat wrapped(const Image<std::uint8_t>& picture) {
    const auto view = picture.view();
    return {view.height(), view.width(), CV_8U, const_cast<std::uint8_t*>(view.row_span(0).data()),
            static_cast<std::size_t>(view.stride())};
}

ViewFeatures features_of(const CalibrationPicture& picture, const FollowOptions& options) {
    cv::Mat inside;
    cv::threshold(wrapped(picture.alpha), inside, 250, 255, cv::THRESH_BINARY);
    const int side = 2 * options.rim_px + 1;
    cv::erode(inside, inside, cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side}), {-1, -1}, 1,
              cv::BORDER_REPLICATE);
    // SIFT's own limit would be filled by the backdrop: it counts before it looks at the mask.
    const auto sift = cv::SIFT::create(0, 4, 0.012, 12, kFinestBlur_px);
    std::vector<cv::KeyPoint> points;
    cv::Mat descriptors;
    sift->detect(wrapped(picture.grey), points, inside);
    cv::KeyPointsFilter::retainBest(points, options.most_features);
    sift->compute(wrapped(picture.grey), points, descriptors);

    // A place with two directions is two features there; keep the order OpenCV gives, which is deterministic.
    ViewFeatures features;
    features.descriptors = descriptors;
    for (const cv::KeyPoint& point : points) {
        features.positions.emplace_back(static_cast<double>(point.pt.x) + 0.5, static_cast<double>(point.pt.y) + 0.5);
    }
    for (int row = 0; row < descriptors.rows; ++row) {  // RootSIFT (Arandjelovic and Zisserman, 2012)
        cv::Mat line = features.descriptors.row(row);
        line /= std::max(cv::norm(line, cv::NORM_L1), 1e-9);
        cv::sqrt(line, line);
    }
    return features;
}

// Sets of features, one per view at most.
class Chains {
public:
    explicit Chains(const std::vector<int>& view_of) : parent_(view_of.size()), views_(view_of.size()) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
        for (std::size_t i = 0; i < view_of.size(); ++i) views_[i] = {view_of[i]};
    }
    std::size_t root(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::size_t a, std::size_t b) {
        a = root(a);
        b = root(b);
        if (a == b) return;
        std::vector<int> both;
        std::set_union(views_[a].begin(), views_[a].end(), views_[b].begin(), views_[b].end(),
                       std::back_inserter(both));
        if (both.size() < views_[a].size() + views_[b].size()) return;
        parent_[std::max(a, b)] = std::min(a, b);
        views_[std::max(a, b)].clear();
        views_[std::min(a, b)] = std::move(both);
    }

private:
    std::vector<std::size_t> parent_;
    std::vector<std::vector<int>> views_;  // [root], ascending
};

}  // namespace

std::vector<ViewFeatures> find_features(std::span<const CalibrationPicture> turn, const FollowOptions& options,
                                        Progress* progress) {
    std::vector<ViewFeatures> views(turn.size());
    tbb::parallel_for(std::size_t{0}, turn.size(), [&](std::size_t i) {
        views[i] = features_of(turn[i], options);
        if (progress != nullptr) progress->advance();
    });
    return views;
}

std::vector<FeatureMatch> alike(const ViewFeatures& first, const ViewFeatures& second, double ratio,
                                const MayMatch& may_match) {
    std::vector<FeatureMatch> matches;
    if (first.descriptors.rows < 2 || second.descriptors.rows < 2) return matches;
    cv::Mat products = first.descriptors * second.descriptors.t();  // unit vectors: distance^2 = 2 - 2 * product
    const auto position = [](const ViewFeatures& view, int i) { return view.positions[static_cast<std::size_t>(i)]; };
    std::vector<int> best_of_second(static_cast<std::size_t>(products.cols), -1);
    std::vector<float> product_of_second(static_cast<std::size_t>(products.cols), 0.0F);
    for (int i = 0; i < products.rows; ++i) {
        float* row = products.ptr<float>(i);
        for (int j = 0; j < products.cols; ++j) {
            if (may_match && !may_match(position(first, i), position(second, j))) {
                row[j] = -1;
            } else if (row[j] > product_of_second[static_cast<std::size_t>(j)]) {
                product_of_second[static_cast<std::size_t>(j)] = row[j];
                best_of_second[static_cast<std::size_t>(j)] = i;
            }
        }
    }
    for (int i = 0; i < products.rows; ++i) {
        const float* row = products.ptr<float>(i);
        const auto best = static_cast<int>(std::max_element(row, row + products.cols) - row);
        if (row[best] <= 0 || best_of_second[static_cast<std::size_t>(best)] != i) continue;
        // The second best lies elsewhere: one corner often has several features, of two directions or scales.
        float next = 0;
        for (int j = 0; j < products.cols; ++j) {
            if (row[j] > next && glm::distance(position(second, j), position(second, best)) > 2) next = row[j];
        }
        const double nearest = std::sqrt(std::max(0.0, 2.0 - 2.0 * static_cast<double>(row[best])));
        if (nearest < ratio * std::sqrt(std::max(0.0, 2.0 - 2.0 * static_cast<double>(next))))
            matches.push_back({i, best, row[best]});
    }
    return matches;
}

std::vector<Track> chained(std::span<const ViewFeatures> views, std::span<const PairOfViews> pairs,
                           std::span<const std::vector<FeatureMatch>> matches) {
    std::vector<std::size_t> first_of_view;
    std::vector<int> view_of;
    for (std::size_t view = 0; view < views.size(); ++view) {
        first_of_view.push_back(view_of.size());
        view_of.resize(view_of.size() + views[view].positions.size(), static_cast<int>(view));
    }
    struct Link {
        std::size_t a = 0, b = 0;
        float likeness = 0;
    };
    std::vector<Link> links;
    for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
        const std::size_t first = first_of_view[static_cast<std::size_t>(pairs[pair].first)];
        const std::size_t second = first_of_view[static_cast<std::size_t>(pairs[pair].second)];
        for (const FeatureMatch& match : matches[pair]) {
            links.push_back({first + static_cast<std::size_t>(match.first),
                             second + static_cast<std::size_t>(match.second), match.likeness});
        }
    }
    std::stable_sort(links.begin(), links.end(), [](const Link& a, const Link& b) { return a.likeness > b.likeness; });
    Chains chains(view_of);
    for (const Link& link : links) chains.join(link.a, link.b);

    std::vector<Track> by_root(view_of.size());
    for (std::size_t i = 0; i < view_of.size(); ++i) {
        const auto view = static_cast<std::size_t>(view_of[i]);
        by_root[chains.root(i)].seen.push_back({view_of[i], views[view].positions[i - first_of_view[view]]});
    }
    std::vector<Track> tracks;
    for (Track& track : by_root) {
        if (track.seen.size() >= 3) tracks.push_back(std::move(track));
    }
    return tracks;
}

}  // namespace rs::capture
