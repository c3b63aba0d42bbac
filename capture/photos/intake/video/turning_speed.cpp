#include "capture/photos/intake/video/turning_speed.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/base/parallel.hpp"

#include <glm/glm.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace rs::capture {
namespace {

constexpr double kTargetFlow_px = 3;  // between the frames of a pair
constexpr std::size_t kMaxPairs = 400;
constexpr std::size_t kMinPoints = 12;
constexpr double kStillFraction = 0.12;  // of the change between frames that turn: below it, the object does not turn
constexpr double kSmoothingFraction = 1 / 16.0;  // Gaussian sigma in turning frames, about 22 degrees
constexpr double kMaxRelativeError = 0.15;

// Motion of a point from one image to another.
struct PointFlow {
    glm::dvec2 at_px{};  // in the first image
    glm::dvec2 flow_px{};
};

// Tracks corners of the moving region (pyramidal Lucas-Kanade) with a forward-backward check. Points that do not move
// are left out: they show the background.
std::vector<PointFlow> track_corners(const Image<std::uint8_t>& from, const Image<std::uint8_t>& to,
                                     const Image<std::uint8_t>& region) {
    constexpr int kMaxCorners = 1000;
    constexpr double kMinQuality = 0.01;  // relative to the best corner
    constexpr double kMinDistance_px = 3;
    constexpr int kWindow_px = 9;
    constexpr int kMaxLevel = 2;
    constexpr float kMaxDifference_codes = 12;  // mean absolute difference of the windows
    constexpr float kMaxReturnError_px = 0.5F;
    constexpr float kMinFlow_px = 0.15F;
    const auto mat = [](const Image<std::uint8_t>& image) {
        return cv::Mat1b(image.height(), image.width(), const_cast<std::uint8_t*>(image.data()));
    };
    std::vector<cv::Point2f> corners, tracked, returned;
    cv::goodFeaturesToTrack(mat(from), corners, kMaxCorners, kMinQuality, kMinDistance_px, mat(region));
    if (corners.empty()) return {};
    const auto track = [&](const auto& first, const auto& second, const auto& points, auto& moved, auto& status,
                           auto& difference) {
        cv::calcOpticalFlowPyrLK(mat(first), mat(second), points, moved, status, difference, {kWindow_px, kWindow_px},
                                 kMaxLevel);
    };
    std::vector<std::uint8_t> is_tracked, is_returned;
    std::vector<float> difference, difference_back;
    track(from, to, corners, tracked, is_tracked, difference);
    track(to, from, tracked, returned, is_returned, difference_back);
    std::vector<PointFlow> flows;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (is_tracked[i] == 0 || is_returned[i] == 0 || difference[i] > kMaxDifference_codes) continue;
        const cv::Point2f flow = tracked[i] - corners[i];
        if (cv::norm(returned[i] - corners[i]) > kMaxReturnError_px || cv::norm(flow) < kMinFlow_px) continue;
        flows.push_back({{corners[i].x, corners[i].y}, {flow.x, flow.y}});
    }
    return flows;
}

// Motion between two frames that are `baseline` frames apart.
struct PairMotion {
    double frame = 0;         // midpoint
    double amount_px = 0;     // median length of the corners' motion; 0 if too few move
    double change_codes = 0;  // mean absolute difference over the moving region
    double slope = 0;         // of vertical motion over U, px (fit_vertical_motion())
    double variance = 1e12;   // of `slope`; huge if too few corners move
};

double median_length(const std::vector<PointFlow>& flows) {
    std::vector<double> lengths;
    for (const PointFlow& flow : flows) lengths.push_back(glm::length(flow.flow_px));
    return median_of(std::span(lengths));
}

double mean_abs_difference(const Image<std::uint8_t>& from, const Image<std::uint8_t>& to,
                           const Image<std::uint8_t>& region) {
    std::int64_t sum = 0, count = 0;
    for (std::size_t i = 0; i < region.pixels().size(); ++i) {
        if (region.pixels()[i] == 0) continue;
        sum += std::abs(from.pixels()[i] - to.pixels()[i]);
        ++count;
    }
    return count > 0 ? static_cast<double>(sum) / static_cast<double>(count) : 0;
}

// Iteratively reweighted least squares (Tukey) of vertical motion on 1, V, U, U V.
void fit_vertical_motion(const std::vector<PointFlow>& flows, double width, double height, PairMotion& motion) {
    std::vector<glm::dvec4> rows;
    for (const PointFlow& flow : flows) {
        const double u = (flow.at_px.x - 0.5 * width) / (0.5 * width);
        const double v = (flow.at_px.y - 0.5 * height) / (0.5 * width);
        rows.emplace_back(1, v, u, u * v);
    }
    std::vector<double> weights(rows.size(), 1), residuals(rows.size());
    constexpr int kIterations = 6;
    constexpr double kNoise_px = 0.05;
    for (int iteration = 0; iteration < kIterations; ++iteration) {
        glm::dmat4 normal(1e-9);
        glm::dvec4 right_side(0);
        double weight = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            normal += weights[i] * glm::outerProduct(rows[i], rows[i]);
            right_side += weights[i] * flows[i].flow_px.y * rows[i];
            weight += weights[i];
        }
        const glm::dmat4 inverse = glm::inverse(normal);
        const glm::dvec4 solution = inverse * right_side;
        if (!std::isfinite(glm::dot(solution, solution))) return;
        double squares = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            residuals[i] = std::abs(flows[i].flow_px.y - glm::dot(rows[i], solution));
            squares += weights[i] * residuals[i] * residuals[i];
        }
        const double variance = std::max(kNoise_px * kNoise_px, squares / std::max(1.0, weight - 4));
        motion.slope = solution[2];
        motion.variance = variance * std::max(1e-9, inverse[2][2]);
        const double scale = std::max(kNoise_px, 1.4826 * median(residuals));
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const double r = residuals[i] / (4.7 * scale);
            weights[i] = r < 1 ? (1 - r * r) * (1 - r * r) : 0;
        }
    }
}

PairMotion measure_motion(const FrameCopy& from, const FrameCopy& to, const Image<std::uint8_t>& region) {
    PairMotion motion;
    motion.change_codes = mean_abs_difference(from.luma, to.luma, region);
    const std::vector<PointFlow> flows = track_corners(from.luma, to.luma, region);
    if (flows.size() < kMinPoints) return motion;
    motion.amount_px = median_length(flows);
    fit_vertical_motion(flows, region.width(), region.height(), motion);
    return motion;
}

// 80th percentile: a typical value while the object turns, even if it pauses for more than half of the video.
double percentile_80(const std::vector<PairMotion>& motions, double PairMotion::*value) {
    std::vector<double> values;
    for (const PairMotion& motion : motions) values.push_back(motion.*value);
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 4 / 5);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

std::vector<PairMotion> measure_motions(const std::vector<FrameCopy>& copies, const Image<std::uint8_t>& region,
                                        std::size_t baseline, std::size_t stride, Progress* progress) {
    std::vector<PairMotion> motions((copies.size() - baseline - 1) / stride + 1);
    // The callback never fails.
    (void)for_each_in_parallel(static_cast<int>(motions.size()), "measuring the turn", progress, [&](int i) -> Status {
        const std::size_t from = static_cast<std::size_t>(i) * stride;
        PairMotion& motion = motions[static_cast<std::size_t>(i)];
        motion = measure_motion(copies[from], copies[from + baseline], region);
        motion.frame = static_cast<double>(from) + 0.5 * static_cast<double>(baseline);
        return {};
    });
    return motions;
}

// Chooses the distance of the frames of a pair, so that corners move by about kTargetFlow_px.
std::size_t choose_baseline(const std::vector<FrameCopy>& copies, const Image<std::uint8_t>& region) {
    constexpr std::size_t kPairs = 16;
    std::size_t baseline = 1;
    for (; baseline * 2 <= copies.size() / 8; baseline *= 2) {
        const std::size_t stride = std::max<std::size_t>(1, (copies.size() - baseline) / kPairs);
        const std::vector<PairMotion> motions = measure_motions(copies, region, baseline, stride, nullptr);
        if (percentile_80(motions, &PairMotion::amount_px) > kTargetFlow_px / 1.5) break;
    }
    return baseline;
}

struct SmoothedSpeed {
    double speed = 0;
    double error = 0;  // standard deviation
};

// Fits a line to the speeds around pair `i` with Gaussian weights in time. A weighted mean would be biased at both ends
// of the film.
SmoothedSpeed smooth_at(std::size_t i, const std::vector<PairMotion>& motions, const std::vector<bool>& is_still,
                        double deviation_frames) {
    const auto for_each_neighbour = [&](const auto& use) {
        for (std::size_t j = 0; j < motions.size(); ++j) {
            const double t = (motions[j].frame - motions[i].frame) / deviation_frames;
            if (!is_still[j] && std::abs(t) < 3) use(t, std::exp(-0.5 * t * t) / motions[j].variance, motions[j].slope);
        }
    };
    double w0 = 0, w1 = 0, w2 = 0, s0 = 0, s1 = 0, squares = 0;
    for_each_neighbour([&](double t, double w, double speed) {
        w0 += w;
        w1 += w * t;
        w2 += w * t * t;
        s0 += w * speed;
        s1 += w * t * speed;
        squares += w * w;
    });
    const double determinant = w0 * w2 - w1 * w1;
    const bool is_line = determinant > 1e-3 * w0 * w0;
    const double at = is_line ? (w2 * s0 - w1 * s1) / determinant : s0 / w0;
    const double slope = is_line ? (w0 * s1 - w1 * s0) / determinant : 0;
    double spread = 0;
    for_each_neighbour([&](double t, double w, double speed) {
        const double off = speed - at - slope * t;
        spread += w * off * off;
    });
    const double effective = std::max(1.0, 0.5 * w0 * w0 / squares);  // pairs overlap by half
    return {at, std::sqrt(spread / w0 / effective)};
}

// Speeds from vertical motion; empty if their error is too large.
std::vector<double> measured_speeds(const std::vector<PairMotion>& motions, const std::vector<bool>& is_still,
                                    double amount_px, double deviation_frames) {
    // Ratio of vertical motion at the left and right image edges to the corners' motion, which is mostly horizontal.
    constexpr double kMinVerticalRatio = 0.15;
    std::vector<double> smoothed(motions.size(), 0), turning, errors;
    for (std::size_t i = 0; i < motions.size(); ++i) {
        if (is_still[i]) continue;
        const SmoothedSpeed here = smooth_at(i, motions, is_still, deviation_frames);
        smoothed[i] = here.speed;
        turning.push_back(here.speed);
        errors.push_back(here.error);
    }
    const double typical = std::abs(median(turning));
    if (!(typical > kMinVerticalRatio * amount_px && median(errors) < kMaxRelativeError * typical)) return {};
    const double sign = median(turning) < 0 ? -1 : 1;  // direction of rotation
    for (std::size_t i = 0; i < smoothed.size(); ++i) {
        if (!is_still[i]) smoothed[i] = std::clamp(sign * smoothed[i], 0.1 * typical, 10 * typical);
    }
    return smoothed;
}

// Fits exp(p + q t) to the magnitude of motion (Theil-Sen estimator).
std::vector<double> fit_trend(const std::vector<PairMotion>& motions, const std::vector<bool>& is_still) {
    std::vector<double> trend(motions.size(), 0), slopes, offsets;
    const auto is_turning = [&](std::size_t i) { return !is_still[i] && motions[i].amount_px > 0; };
    const auto log_amount = [&](std::size_t i) { return std::log(motions[i].amount_px); };
    for (std::size_t i = 0; i < motions.size(); ++i) {
        for (std::size_t j = i + motions.size() / 4 + 1; j < motions.size(); ++j) {
            if (!is_turning(i) || !is_turning(j)) continue;
            slopes.push_back((log_amount(j) - log_amount(i)) / (motions[j].frame - motions[i].frame));
        }
    }
    const double slope = median(slopes);
    for (std::size_t i = 0; i < motions.size(); ++i) {
        if (is_turning(i)) offsets.push_back(log_amount(i) - slope * motions[i].frame);
    }
    const double offset = median(offsets);
    for (std::size_t i = 0; i < motions.size(); ++i) {
        if (!is_still[i]) trend[i] = std::exp(offset + slope * motions[i].frame);
    }
    return trend;
}

std::vector<double> interpolate_per_frame(const std::vector<PairMotion>& motions, const std::vector<double>& speeds,
                                          std::size_t frames) {
    std::vector<double> result(frames, 0);
    std::size_t next = 0;
    for (std::size_t frame = 0; frame < frames; ++frame) {
        const double at = static_cast<double>(frame) + 0.5;
        while (next < motions.size() && motions[next].frame < at) ++next;
        if (next == 0 || next == motions.size()) {
            result[frame] = speeds[std::min(next, motions.size() - 1)];
            continue;
        }
        const double a = speeds[next - 1], b = speeds[next];
        const double t = (at - motions[next - 1].frame) / (motions[next].frame - motions[next - 1].frame);
        result[frame] = a == 0 || b == 0 ? (t < 0.5 ? a : b) : (1 - t) * a + t * b;
    }
    return result;
}

}  // namespace

TurningSpeed turning_speed(const std::vector<FrameCopy>& copies, const Image<std::uint8_t>& region,
                           Progress* progress) {
    RS_CHECK(!copies.empty());
    constexpr std::size_t kMinCopies = 8;
    TurningSpeed result{std::vector<double>(copies.size(), 1.0), false};
    if (copies.size() < kMinCopies) return result;
    const std::size_t baseline = choose_baseline(copies, region);
    const std::size_t stride = std::max({std::size_t{1}, baseline / 2, copies.size() / kMaxPairs});
    const std::vector<PairMotion> motions = measure_motions(copies, region, baseline, stride, progress);
    const double amount_px = percentile_80(motions, &PairMotion::amount_px);
    const double change_codes = percentile_80(motions, &PairMotion::change_codes);
    if (!(amount_px > 0)) return result;
    std::vector<bool> is_still;
    for (const PairMotion& motion : motions) is_still.push_back(motion.change_codes < kStillFraction * change_codes);
    const std::ptrdiff_t turning_frames = std::ranges::count(is_still, false) * static_cast<std::ptrdiff_t>(stride);
    const double deviation_frames = std::max(1.0, kSmoothingFraction * static_cast<double>(turning_frames));
    std::vector<double> speeds = measured_speeds(motions, is_still, amount_px, deviation_frames);
    result.is_measured = !speeds.empty();
    if (!result.is_measured) speeds = fit_trend(motions, is_still);
    result.per_frame = interpolate_per_frame(motions, speeds, copies.size());
    return result;
}

}  // namespace rs::capture
