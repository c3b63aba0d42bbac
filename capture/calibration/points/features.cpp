#include "capture/calibration/points/features.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

namespace rs::capture {
namespace {

// Smaller than SIFT's default of 1.6: gives twice the points on fur, leaves and thin glazes; alignment makes them
// accurate.
constexpr double kFinestBlur_px = 1.2;

// Margin around the object that is searched, too: the support of descriptors near the silhouette. Its corner is on a
// pixel of images halved four times, so that features are the same as those of the whole image.
constexpr int kBeside_px = 32;
constexpr int kLattice_px = 16;

// The part of the image that is needed for features within `inside`.
cv::Rect part_around(const cv::Mat1b& inside) {
    const cv::Rect box = bounding_box(inside);
    const cv::Point corner(std::max(0, box.x - kBeside_px) / kLattice_px * kLattice_px,
                           std::max(0, box.y - kBeside_px) / kLattice_px * kLattice_px);
    const cv::Point end(std::min(inside.cols, box.br().x + kBeside_px), std::min(inside.rows, box.br().y + kBeside_px));
    return {corner, end};
}

// RootSIFT (Arandjelovic and Zisserman, 2012).
Descriptors root_sift(const cv::Mat1f& sift) {
    Descriptors roots;
    roots.reserve(static_cast<std::size_t>(sift.rows) * kDescriptorNumbers);
    for (int row = 0; row < sift.rows; ++row) {
        const float* const numbers = sift[row];
        double sum = 0;
        for (int k = 0; k < sift.cols; ++k) sum += static_cast<double>(std::abs(numbers[k]));
        const double scale = 1 / std::max(sum, 1e-9);
        for (int k = 0; k < sift.cols; ++k) {
            const double root = std::sqrt(std::max(0.0, static_cast<double>(numbers[k]) * scale));
            roots.push_back(static_cast<std::int16_t>(std::lround(kDescriptorUnit * root)));
        }
    }
    return roots;
}

ViewFeatures features_of(const CalibrationImage& image, const TrackingOptions& options) {
    cv::Mat inside;
    cv::threshold(mat_view(image.alpha), inside, 250, 255, cv::THRESH_BINARY);
    const int side = 2 * options.margin_px + 1;
    cv::erode(inside, inside, cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side}), {-1, -1}, 1,
              cv::BORDER_REPLICATE);
    // SIFT's own limit would be filled by the backdrop, because SIFT counts before it applies the mask.
    const auto sift = cv::SIFT::create(0, 4, 0.012, 12, kFinestBlur_px);
    std::vector<cv::KeyPoint> points;
    cv::Mat descriptors;
    const cv::Rect part = part_around(inside);
    const cv::Mat grey = mat_view(image.grey)(part);
    sift->detect(grey, points, inside(part));
    cv::KeyPointsFilter::retainBest(points, options.max_features);
    sift->compute(grey, points, descriptors);

    // A point with two orientations yields two features; OpenCV's order, which is deterministic, is kept.
    ViewFeatures features;
    for (const cv::KeyPoint& point : points) {
        features.positions.emplace_back(part.x + static_cast<double>(point.pt.x) + 0.5,
                                        part.y + static_cast<double>(point.pt.y) + 0.5);
    }
    features.descriptors = root_sift(descriptors);
    features.packed = PackedDescriptors(features.descriptors);
    return features;
}

// Disjoint sets of features with at most one per view.
class DisjointTracks {
public:
    explicit DisjointTracks(const std::vector<int>& view_of) : parent_(view_of.size()), views_(view_of.size()) {
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
    std::vector<std::vector<int>> views_;  // [root], ascending view numbers
};

}  // namespace

std::vector<ViewFeatures> find_features(std::span<const CalibrationImage> turn, const TrackingOptions& options,
                                        Progress* progress) {
    std::vector<ViewFeatures> views(turn.size());
    for_each_index(turn.size(), [&](std::size_t i) {
        views[i] = features_of(turn[i], options);
        if (progress != nullptr) progress->advance();
    });
    return views;
}

namespace {

// Distance of two descriptors with inner product `product`, as a fraction of their length.
double distance_of(std::int32_t product) {
    constexpr double kSame = static_cast<double>(kDescriptorUnit) * kDescriptorUnit;
    return std::sqrt(std::max(0.0, 2.0 - 2.0 * static_cast<double>(product) / kSame));
}

// The second best match must be at another position: one corner often has several features, of two orientations or
// scales.
constexpr double kElsewhere_px = 2;

bool is_distinct(const ViewFeatures& view, std::size_t a, std::size_t b) {
    return glm::distance(view.positions[a], view.positions[b]) > kElsewhere_px;
}

// Best match in the first view of each feature of the second view.
class BestOfSecond {
public:
    explicit BestOfSecond(std::size_t count) : product_(count, 0), feature_(count, -1) {}
    void offer(std::size_t second, int first, std::int32_t product) {
        if (product <= product_[second]) return;
        product_[second] = product;
        feature_[second] = first;
    }
    [[nodiscard]] bool is(std::size_t second, int first) const { return feature_[second] == first; }

private:
    std::vector<std::int32_t> product_;
    std::vector<int> feature_;
};

// The two best matches of one feature of the first view.
struct TwoBest {
    std::size_t best = 0;
    std::int32_t product = 0;  // 0: no match
    std::int32_t next = 0;
};

std::vector<FeatureMatch> mutual_matches(const std::vector<TwoBest>& of_first, const BestOfSecond& of_second,
                                         double ratio) {
    std::vector<FeatureMatch> matches;
    for (std::size_t i = 0; i < of_first.size(); ++i) {
        const TwoBest& two = of_first[i];
        if (two.product <= 0 || !of_second.is(two.best, static_cast<int>(i))) continue;
        if (!(distance_of(two.product) < ratio * distance_of(two.next))) continue;
        matches.push_back({static_cast<int>(i), static_cast<int>(two.best), static_cast<float>(two.product)});
    }
    return matches;
}

}  // namespace

double Segment::distance(const glm::dvec2& p) const {
    const glm::dvec2 along = to - from;
    const double t = std::clamp(glm::dot(p - from, along) / std::max(1e-12, glm::dot(along, along)), 0.0, 1.0);
    return glm::distance(p, from + t * along);
}

std::vector<FeatureMatch> match_features(const ViewFeatures& first, const ViewFeatures& second, double ratio) {
    const std::size_t rows = first.positions.size(), columns = second.positions.size();
    if (rows < 2 || columns < 2) return {};
    const std::size_t stride = second.packed.stride();
    std::vector<std::int32_t> products(4 * stride);
    std::vector<TwoBest> of_first(rows);
    BestOfSecond of_second(columns);
    for (std::size_t i = 0; i < rows; i += 4) {
        const std::size_t count = std::min<std::size_t>(4, rows - i);
        const auto descriptors = std::span(first.descriptors).subspan(i * kDescriptorNumbers);
        if (count == 4) {
            four_descriptor_products(descriptors.first(4 * kDescriptorNumbers), second.packed, products);
        } else {
            for (std::size_t r = 0; r < count; ++r) {
                descriptor_products(descriptors.subspan(r * kDescriptorNumbers, kDescriptorNumbers), second.packed,
                                    std::span(products).subspan(r * stride, stride));
            }
        }
        for (std::size_t r = 0; r < count; ++r) {
            const std::int32_t* const row = products.data() + r * stride;
            TwoBest& two = of_first[i + r];
            for (std::size_t j = 0; j < columns; ++j) {
                of_second.offer(j, static_cast<int>(i + r), row[j]);
                if (row[j] > two.product) {
                    two.product = row[j];
                    two.best = j;
                }
            }
            for (std::size_t j = 0; j < columns; ++j) {
                if (row[j] > two.next && is_distinct(second, j, two.best)) two.next = row[j];
            }
        }
    }
    return mutual_matches(of_first, of_second, ratio);
}

std::vector<FeatureMatch> match_guided(const ViewFeatures& first, const ViewFeatures& second, double ratio,
                                       const SearchSegment& search_segment, double band_px) {
    constexpr double kRounding_px = 1e-3;
    const std::size_t rows = first.positions.size(), columns = second.positions.size();
    if (rows < 2 || columns < 2) return {};
    // Sorted from left to right, so that few need be tested.
    std::vector<std::size_t> order(columns);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return second.positions[a].x < second.positions[b].x; });
    const auto descriptor = [](const ViewFeatures& view, std::size_t i) {
        return std::span(view.descriptors).subspan(i * kDescriptorNumbers, kDescriptorNumbers);
    };
    std::vector<TwoBest> of_first(rows);
    BestOfSecond of_second(columns);
    std::vector<std::pair<std::size_t, std::int32_t>> near;  // feature of the second view, product
    for (std::size_t i = 0; i < rows; ++i) {
        const auto where = search_segment(first.positions[i]);
        if (!where) continue;
        near.clear();
        const double left = std::min(where->from.x, where->to.x) - band_px;
        const double right = std::max(where->from.x, where->to.x) + band_px;
        // Most features are above or below the whole segment; their distance need not be computed.
        const double highest = std::min(where->from.y, where->to.y) - band_px - kRounding_px;
        const double lowest = std::max(where->from.y, where->to.y) + band_px + kRounding_px;
        auto at = std::lower_bound(order.begin(), order.end(), left,
                                   [&](std::size_t j, double x) { return second.positions[j].x < x; });
        for (; at != order.end() && second.positions[*at].x <= right; ++at) {
            const glm::dvec2& there = second.positions[*at];
            if (there.y < highest || there.y > lowest || where->distance(there) > band_px) continue;
            near.emplace_back(*at, descriptor_product(descriptor(first, i), descriptor(second, *at)));
        }
        std::sort(near.begin(), near.end());
        TwoBest& two = of_first[i];
        for (const auto& [j, product] : near) {
            of_second.offer(j, static_cast<int>(i), product);
            if (product > two.product) {
                two.product = product;
                two.best = j;
            }
        }
        for (const auto& [j, product] : near) {
            if (product > two.next && is_distinct(second, j, two.best)) two.next = product;
        }
    }
    return mutual_matches(of_first, of_second, ratio);
}

std::vector<Track> build_tracks(std::span<const ViewFeatures> views, std::span<const MatchedPair> pairs,
                                std::span<const std::vector<FeatureMatch>> matches) {
    std::vector<std::size_t> first_of_view;
    std::vector<int> view_of;
    for (std::size_t view = 0; view < views.size(); ++view) {
        first_of_view.push_back(view_of.size());
        view_of.resize(view_of.size() + views[view].positions.size(), static_cast<int>(view));
    }
    struct Link {
        std::size_t a = 0, b = 0;
        float similarity = 0;
    };
    std::vector<Link> links;
    for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
        const std::size_t first = first_of_view[static_cast<std::size_t>(pairs[pair].first)];
        const std::size_t second = first_of_view[static_cast<std::size_t>(pairs[pair].second)];
        for (const FeatureMatch& match : matches[pair]) {
            links.push_back({first + static_cast<std::size_t>(match.first),
                             second + static_cast<std::size_t>(match.second), match.similarity});
        }
    }
    std::stable_sort(links.begin(), links.end(),
                     [](const Link& a, const Link& b) { return a.similarity > b.similarity; });
    DisjointTracks sets(view_of);
    for (const Link& link : links) sets.join(link.a, link.b);

    std::vector<Track> by_root(view_of.size());
    for (std::size_t i = 0; i < view_of.size(); ++i) {
        const auto view = static_cast<std::size_t>(view_of[i]);
        by_root[sets.root(i)].seen.push_back({view_of[i], views[view].positions[i - first_of_view[view]]});
    }
    std::vector<Track> tracks;
    for (Track& track : by_root) {
        if (track.seen.size() >= 3) tracks.push_back(std::move(track));
    }
    return tracks;
}

}  // namespace rs::capture
