#include "capture/calibration/tracks.hpp"

#include "rayspace/check.hpp"

#include <tbb/parallel_for.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace rs::capture {
namespace {

constexpr double kRatio = 0.8;            // Lowe: best distance over second best
constexpr double kEpipolarBand_px = 1.5;  // at 1000 px of the longer side; grows with the picture
constexpr int kFewestMatches = 12;        // below, a pair says nothing

struct ViewFeatures {
    std::vector<cv::Point2f> positions;  // OpenCV's convention
    cv::Mat descriptors;                 // one row each, square roots of L1-normalised SIFT
};

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
    const auto sift = cv::SIFT::create(options.most_features, 4, 0.012, 12);
    std::vector<cv::KeyPoint> points;
    cv::Mat descriptors;
    sift->detectAndCompute(wrapped(picture.grey), inside, points, descriptors);

    // A place with two directions is two features there; keep the order OpenCV gives, which is deterministic.
    ViewFeatures features;
    features.descriptors = descriptors;
    for (const cv::KeyPoint& point : points) features.positions.push_back(point.pt);
    for (int row = 0; row < descriptors.rows; ++row) {  // RootSIFT (Arandjelovic and Zisserman, 2012)
        cv::Mat line = features.descriptors.row(row);
        line /= std::max(cv::norm(line, cv::NORM_L1), 1e-9);
        cv::sqrt(line, line);
    }
    return features;
}

struct Match {
    int first = 0;
    int second = 0;
};

// Mutual best matches that pass the ratio test.
std::vector<Match> alike(const ViewFeatures& a, const ViewFeatures& b) {
    std::vector<Match> matches;
    if (a.descriptors.rows < 2 || b.descriptors.rows < 2) return matches;
    const cv::Mat products = a.descriptors * b.descriptors.t();  // unit vectors: distance^2 = 2 - 2 * product
    std::vector<int> best_of_b(static_cast<std::size_t>(products.cols), -1);
    std::vector<float> product_of_b(static_cast<std::size_t>(products.cols), -1.0F);
    for (int i = 0; i < products.rows; ++i) {
        const float* row = products.ptr<float>(i);
        for (int j = 0; j < products.cols; ++j) {
            if (row[j] > product_of_b[static_cast<std::size_t>(j)]) {
                product_of_b[static_cast<std::size_t>(j)] = row[j];
                best_of_b[static_cast<std::size_t>(j)] = i;
            }
        }
    }
    for (int i = 0; i < products.rows; ++i) {
        const float* row = products.ptr<float>(i);
        int best = 0;
        for (int j = 1; j < products.cols; ++j) {
            if (row[j] > row[best]) best = j;
        }
        // The second best lies elsewhere: one corner often has several features, of two directions or scales.
        float second = -1;
        const cv::Point2f at = b.positions[static_cast<std::size_t>(best)];
        for (int j = 0; j < products.cols; ++j) {
            const cv::Point2f off = b.positions[static_cast<std::size_t>(j)] - at;
            if (row[j] > second && off.dot(off) > 4.0F) second = row[j];
        }
        const double nearest = std::sqrt(std::max(0.0, 2.0 - 2.0 * static_cast<double>(row[best])));
        const double next = std::sqrt(std::max(0.0, 2.0 - 2.0 * static_cast<double>(second)));
        if (nearest < kRatio * next && best_of_b[static_cast<std::size_t>(best)] == i) matches.push_back({i, best});
    }
    return matches;
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

// Those that agree with one epipolar geometry (RANSAC with OpenCV's fixed seed).
std::vector<Match> consistent(const std::vector<Match>& matches, const ViewFeatures& a, const ViewFeatures& b,
                              double band_px) {
    if (static_cast<int>(matches.size()) < kFewestMatches) return {};
    std::vector<cv::Point2f> in_a, in_b;
    for (const Match& match : matches) {
        in_a.push_back(a.positions[static_cast<std::size_t>(match.first)]);
        in_b.push_back(b.positions[static_cast<std::size_t>(match.second)]);
    }
    std::vector<std::uint8_t> good;
    const cv::Mat f = cv::findFundamentalMat(in_a, in_b, cv::FM_RANSAC, band_px, 0.999, 3000, good);
    std::vector<Match> kept;
    if (f.empty()) return kept;
    for (std::size_t i = 0; i < matches.size(); ++i) {
        if (good[i] != 0) kept.push_back(matches[i]);
    }
    if (static_cast<int>(kept.size()) < kFewestMatches) kept.clear();
    return kept;
}

class Unions {
public:
    explicit Unions(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
    std::size_t root(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::size_t a, std::size_t b) { parent_[std::max(root(a), root(b))] = std::min(root(a), root(b)); }

private:
    std::vector<std::size_t> parent_;
};

// A feature seen twice in one view makes its whole chain doubtful; such chains are left out.
std::vector<Track> chained(const std::vector<ViewFeatures>& views, const std::vector<PairOfViews>& pairs,
                           const std::vector<std::vector<Match>>& matches) {
    std::vector<std::size_t> first_of_view{0};
    for (const ViewFeatures& view : views) first_of_view.push_back(first_of_view.back() + view.positions.size());
    Unions unions(first_of_view.back());
    for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
        for (const Match& match : matches[pair]) {
            unions.join(
                first_of_view[static_cast<std::size_t>(pairs[pair].first)] + static_cast<std::size_t>(match.first),
                first_of_view[static_cast<std::size_t>(pairs[pair].second)] + static_cast<std::size_t>(match.second));
        }
    }
    std::vector<Track> by_root(first_of_view.back());
    std::vector<bool> doubtful(first_of_view.back(), false);
    for (std::size_t view = 0; view < views.size(); ++view) {
        for (std::size_t i = 0; i < views[view].positions.size(); ++i) {
            const std::size_t root = unions.root(first_of_view[view] + i);
            const cv::Point2f p = views[view].positions[i];
            const glm::dvec2 here(static_cast<double>(p.x) + 0.5, static_cast<double>(p.y) + 0.5);
            auto& seen = by_root[root].seen;
            if (!seen.empty() && seen.back().view == static_cast<int>(view)) {
                // Two features at one corner are one observation.
                if (glm::distance(seen.back().p, here) > 1.0) doubtful[root] = true;
                continue;
            }
            seen.push_back({static_cast<int>(view), here});
        }
    }
    std::vector<Track> tracks;
    for (std::size_t root = 0; root < by_root.size(); ++root) {
        if (!doubtful[root] && by_root[root].seen.size() >= 3) tracks.push_back(std::move(by_root[root]));
    }
    return tracks;
}

}  // namespace

CalibrationPicture calibration_picture(ConstImageView<Rgba8> picture, int reduction) {
    RS_CHECK(reduction >= 1);
    const int width = std::max(1, picture.width() / reduction);
    const int height = std::max(1, picture.height() / reduction);
    CalibrationPicture result{Image<std::uint8_t>(width, height), Image<std::uint8_t>(width, height)};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            int luma = 0, alpha = 0, count = 0;
            for (int dy = 0; dy < reduction && y * reduction + dy < picture.height(); ++dy) {
                for (int dx = 0; dx < reduction && x * reduction + dx < picture.width(); ++dx) {
                    const Rgba8 p = picture(x * reduction + dx, y * reduction + dy);
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

Result<FollowedPoints> follow_points(std::span<const CalibrationPicture> turn, const FollowOptions& options,
                                     Progress* progress) {
    const int count = static_cast<int>(turn.size());
    FollowedPoints found;
    if (count < 2) return found;
    const double longer = std::max(turn.front().grey.width(), turn.front().grey.height());
    const double band_px = kEpipolarBand_px * std::max(1.0, longer / 1000);
    try {
        std::vector<ViewFeatures> views(turn.size());
        tbb::parallel_for(std::size_t{0}, turn.size(), [&](std::size_t i) {
            views[i] = features_of(turn[i], options);
            if (progress != nullptr) progress->advance();
        });
        for (const ViewFeatures& view : views) found.features.push_back(static_cast<int>(view.positions.size()));

        std::set<std::pair<int, int>> wanted;
        for (int i = 0; i < count; ++i) {
            for (int step = 1; step <= options.farthest_neighbour && step < count; ++step) {
                const int other = (i + step) % count;
                if (!wanted.contains({other, i})) wanted.insert({i, other});
            }
        }
        for (const auto& [first, second] : wanted) found.pairs.push_back({.first = first, .second = second});
        std::vector<std::vector<Match>> matches(found.pairs.size());
        tbb::parallel_for(std::size_t{0}, found.pairs.size(), [&](std::size_t i) {
            PairOfViews& pair = found.pairs[i];
            const ViewFeatures& a = views[static_cast<std::size_t>(pair.first)];
            const ViewFeatures& b = views[static_cast<std::size_t>(pair.second)];
            matches[i] = consistent(alike(a, b), a, b, band_px);
            pair.matches = static_cast<int>(matches[i].size());
            std::vector<double> dx, dy;
            for (const Match& match : matches[i]) {
                const cv::Point2f motion = b.positions[static_cast<std::size_t>(match.second)] -
                                           a.positions[static_cast<std::size_t>(match.first)];
                dx.push_back(static_cast<double>(motion.x));
                dy.push_back(static_cast<double>(motion.y));
                pair.spread_x_px += std::abs(dx.back()) / static_cast<double>(matches[i].size());
                pair.spread_y_px += std::abs(dy.back()) / static_cast<double>(matches[i].size());
            }
            pair.motion_x_px = median(dx);
            pair.motion_y_px = median(dy);
            if (progress != nullptr && pair.second == (pair.first + 1) % count) progress->advance();
        });
        found.tracks = chained(views, found.pairs, matches);
    } catch (const cv::Exception& escaped) {
        return Error{std::string("the pictures' features cannot be followed (OpenCV: ") + escaped.what() + ")"};
    }
    return found;
}

}  // namespace rs::capture
