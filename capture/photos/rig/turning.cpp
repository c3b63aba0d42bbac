#include "capture/photos/rig/turning.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kCompared_px = 15;
constexpr int kGrid_px = 12;
constexpr std::size_t kMaxPairs = 24;
constexpr float kMinMatch = 0.85F;     // normalised correlation
constexpr double kMinContrast = 10;    // standard deviation of a patch, grey codes
constexpr int kMaxReturnError_px = 1;  // of a patch that is matched forth and back
constexpr double kNearAxis = 0.5;      // fraction of the widest extent
constexpr int kMinPatches = 30;
constexpr double kFrontMajority = 0.75;
constexpr double kClearSlope = 8;  // standard errors; errors of patches on one part of the object are correlated

struct Motion {
    double x_px, y_px;  // midpoint of the patch's motion, from the axis and from the top
    double dx_px, dy_px;
};

cv::Mat1b grey(ConstImageView<Rgba8> image) {
    cv::Mat1b result(image.height(), image.width());
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const Rgba8& p = image(x, y);
            result(y, x) = static_cast<std::uint8_t>((299 * p.r + 587 * p.g + 114 * p.b) * p.a / 255000);
        }
    }
    return result;
}

// True if all pixels of the patch belong to the object.
bool is_solid(ConstImageView<Rgba8> image, int left, int top) {
    for (int y = top; y < top + kCompared_px; ++y) {
        for (int x = left; x < left + kCompared_px; ++x) {
            if (image(x, y).a < 250) return false;
        }
    }
    return true;
}

// Finds the patch of `from` at `at` in `to`, in a window of +-`reach` px. Nullopt if no position is similar enough, or
// if the best one is on the border of the window.
std::optional<cv::Point> find_patch(const cv::Mat1b& from, const cv::Mat1b& to, cv::Point at, cv::Size reach) {
    const cv::Rect everywhere(0, 0, to.cols, to.rows);
    const cv::Rect window = everywhere & cv::Rect(at.x - reach.width, at.y - reach.height,
                                                  kCompared_px + 2 * reach.width, kCompared_px + 2 * reach.height);
    if (window.width <= kCompared_px || window.height <= kCompared_px) return std::nullopt;
    cv::Mat1f similarity;
    cv::matchTemplate(to(window), from(cv::Rect(at, cv::Size(kCompared_px, kCompared_px))), similarity,
                      cv::TM_CCOEFF_NORMED);
    double best = 0;
    cv::Point where;
    cv::minMaxLoc(similarity, nullptr, &best, nullptr, &where);
    const bool at_edge =
        where.x == 0 || where.y == 0 || where.x == similarity.cols - 1 || where.y == similarity.rows - 1;
    if (!(best >= kMinMatch) || at_edge) return std::nullopt;
    return window.tl() + where;
}

std::vector<Motion> motions_between(ConstImageView<Rgba8> first, ConstImageView<Rgba8> second, double axis_x_px,
                                    cv::Size reach) {
    std::vector<Motion> motions;
    const cv::Mat1b from = grey(first);
    const cv::Mat1b to = grey(second);
    for (int y = 0; y + kCompared_px <= from.rows; y += kGrid_px) {
        for (int x = 0; x + kCompared_px <= from.cols; x += kGrid_px) {
            if (!is_solid(first, x, y)) continue;
            cv::Scalar mean;
            cv::Scalar deviation;
            cv::meanStdDev(from(cv::Rect(x, y, kCompared_px, kCompared_px)), mean, deviation);
            if (deviation[0] < kMinContrast) continue;
            const auto there = find_patch(from, to, {x, y}, reach);
            if (!there || !is_solid(second, there->x, there->y)) continue;
            const auto back = find_patch(to, from, *there, reach);
            if (!back || std::abs(back->x - x) > kMaxReturnError_px || std::abs(back->y - y) > kMaxReturnError_px)
                continue;
            const double centre = kCompared_px / 2.0;
            motions.push_back({(x + there->x) / 2.0 + centre - axis_x_px, (y + there->y) / 2.0 + centre,
                               static_cast<double>(there->x - x), static_cast<double>(there->y - y)});
        }
    }
    return motions;
}

// Fits dy = slope * x + offset by least squares.
void fit_sinking(const std::vector<Motion>& low, TurningEvidence& evidence) {
    if (low.size() < kMinPatches) return;
    const auto n = static_cast<double>(low.size());
    double mean_x = 0;
    double mean_dy = 0;
    for (const Motion& m : low) {
        mean_x += m.x_px / n;
        mean_dy += m.dy_px / n;
    }
    double xx = 0;
    double xy = 0;
    for (const Motion& m : low) {
        xx += (m.x_px - mean_x) * (m.x_px - mean_x);
        xy += (m.x_px - mean_x) * (m.dy_px - mean_dy);
    }
    if (xx <= 0) return;
    evidence.sink_slope = xy / xx;
    double residual = 0;
    for (const Motion& m : low) {
        residual += std::pow(m.dy_px - mean_dy - evidence.sink_slope * (m.x_px - mean_x), 2);
    }
    evidence.sink_slope_error = std::sqrt(residual / (n - 2) / xx);
}

}  // namespace

TurningEvidence find_turning(std::span<const Image<Rgba8>> turn, double axis_x_px, double half_width_px,
                             double step_rad, bool closed) {
    TurningEvidence evidence;
    const std::size_t count = turn.size();
    if (count < 3) return evidence;
    const std::size_t neighbours = closed ? count : count - 1;
    const std::size_t pairs = std::min(neighbours, kMaxPairs);
    // The fastest point moves by extent * step. The window allows slightly more sideways and a fraction of it
    // vertically.
    const double fastest_px = half_width_px * step_rad;
    const cv::Size reach(static_cast<int>(std::lround(1.3 * fastest_px)) + 4,
                         static_cast<int>(std::lround(0.4 * fastest_px)) + 3);

    std::vector<std::vector<Motion>> found(pairs);
    for_each_index(pairs, [&](std::size_t k) {
        const std::size_t i = k * neighbours / pairs;
        found[k] = motions_between(turn[i], turn[(i + 1) % count], axis_x_px, reach);
    });

    double top = 1e9;
    double bottom = 0;
    for (const auto& motions : found) {
        for (const Motion& m : motions) {
            top = std::min(top, m.y_px);
            bottom = std::max(bottom, m.y_px);
        }
    }
    std::vector<Motion> low;
    for (const auto& motions : found) {
        for (const Motion& m : motions) {
            ++evidence.patches;
            if (std::abs(m.x_px) < kNearAxis * half_width_px) {
                evidence.front_right += m.dx_px >= 1 ? 1 : 0;
                evidence.front_left += m.dx_px <= -1 ? 1 : 0;
            }
            if (m.y_px > (top + bottom) / 2) low.push_back(m);
        }
    }
    fit_sinking(low, evidence);

    // If the front moves to the left, patches right of the axis approach and move down: the slope is positive.
    std::optional<Turning> by_slope;
    if (evidence.sink_slope_error > 0 && std::abs(evidence.sink_slope) > kClearSlope * evidence.sink_slope_error) {
        by_slope = evidence.sink_slope > 0 ? Turning::kClockwise : Turning::kCounterClockwise;
    }
    std::optional<Turning> by_front;
    const int front = evidence.front_right + evidence.front_left;
    if (front >= kMinPatches && std::max(evidence.front_left, evidence.front_right) >= kFrontMajority * front) {
        by_front = evidence.front_left > evidence.front_right ? Turning::kClockwise : Turning::kCounterClockwise;
    }
    if (by_slope && by_front && *by_slope != *by_front) return evidence;
    evidence.turning = by_slope ? by_slope : by_front;
    return evidence;
}

}  // namespace rs::capture
