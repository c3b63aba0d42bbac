#include "capture/photos/intake/film/point_flow.hpp"

#include "rayspace/base/check.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace rs::capture {
namespace {

constexpr int kLevels = 3;
constexpr int kRadius_px = 4;  // of patches
constexpr int kGrid_px = 4;
constexpr int kRounds = 8;
constexpr double kLeastEigenvalue = 6;       // of the structure tensor per pixel, codes^2: less is noise
constexpr double kStaticDifference = 1.5;    // mean absolute difference of patches without motion, codes
constexpr double kMostDifference = 12;       // after motion, codes
constexpr double kMostReturnError_px = 0.5;  // of the forward-backward check

using Pyramid = std::vector<cv::Mat1f>;

Pyramid pyramid_of(const Image<std::uint8_t>& image) {
    const cv::Mat1b codes(image.height(), image.width(), const_cast<std::uint8_t*>(image.data()));
    cv::Mat1b smooth;
    cv::GaussianBlur(codes, smooth, {3, 3}, 0);
    Pyramid levels(1);
    smooth.convertTo(levels[0], CV_32F);
    constexpr int kLeastSide_px = 4 * kRadius_px;
    while (static_cast<int>(levels.size()) < kLevels &&
           std::min(levels.back().cols, levels.back().rows) >= 2 * kLeastSide_px) {
        cv::Mat1f half;
        cv::pyrDown(levels.back(), half);
        levels.push_back(half);
    }
    return levels;
}

// Bilinear; coordinates are clamped to the image.
float at(const cv::Mat1f& image, double x, double y) {
    x = std::clamp(x, 0.0, image.cols - 1.001);
    y = std::clamp(y, 0.0, image.rows - 1.001);
    const int u = static_cast<int>(x), v = static_cast<int>(y);
    const float a = static_cast<float>(x - u), b = static_cast<float>(y - v);
    const float* const top = image[v] + u;
    const float* const bottom = image[v + 1] + u;
    return (1 - b) * ((1 - a) * top[0] + a * top[1]) + b * ((1 - a) * bottom[0] + a * bottom[1]);
}

constexpr int kPatchSide_px = 2 * kRadius_px + 1;
constexpr int kPatchPixels = kPatchSide_px * kPatchSide_px;

// Codes and gradients of the pixels around a point.
struct Patch {
    std::array<float, kPatchPixels> code{}, gx{}, gy{};
    double xx = 0, xy = 0, yy = 0;  // structure tensor

    Patch(const cv::Mat1f& image, const glm::dvec2& p) {
        std::size_t i = 0;
        for (int dy = -kRadius_px; dy <= kRadius_px; ++dy) {
            for (int dx = -kRadius_px; dx <= kRadius_px; ++dx, ++i) {
                const double x = p.x + dx, y = p.y + dy;
                code[i] = at(image, x, y);
                gx[i] = 0.5F * (at(image, x + 1, y) - at(image, x - 1, y));
                gy[i] = 0.5F * (at(image, x, y + 1) - at(image, x, y - 1));
                xx += gx[i] * gx[i];
                xy += gx[i] * gy[i];
                yy += gy[i] * gy[i];
            }
        }
    }
    [[nodiscard]] double determinant() const { return xx * yy - xy * xy; }
    [[nodiscard]] double smaller_eigenvalue() const {
        return 0.5 * (xx + yy - std::sqrt((xx - yy) * (xx - yy) + 4 * xy * xy));
    }
};

// One level: improves `flow` of the patch around `p`. False where the patch has no corner.
bool refine(const Patch& patch, const cv::Mat1f& to, const glm::dvec2& p, glm::dvec2& flow) {
    if (!(patch.determinant() > 1e-6)) return false;
    for (int round = 0; round < kRounds; ++round) {
        glm::dvec2 b{};
        std::size_t i = 0;
        for (int dy = -kRadius_px; dy <= kRadius_px; ++dy) {
            for (int dx = -kRadius_px; dx <= kRadius_px; ++dx, ++i) {
                const double change = patch.code[i] - at(to, p.x + dx + flow.x, p.y + dy + flow.y);
                b += change * glm::dvec2(patch.gx[i], patch.gy[i]);
            }
        }
        const glm::dvec2 step =
            glm::dvec2(patch.yy * b.x - patch.xy * b.y, patch.xx * b.y - patch.xy * b.x) / patch.determinant();
        if (!(glm::length(step) < 4 * kRadius_px)) return false;
        flow += step;
        if (glm::length(step) < 0.02) break;
    }
    return true;
}

double patch_difference(const cv::Mat1f& from, const cv::Mat1f& to, const glm::dvec2& p, const glm::dvec2& flow) {
    double sum = 0;
    for (int dy = -kRadius_px; dy <= kRadius_px; ++dy) {
        for (int dx = -kRadius_px; dx <= kRadius_px; ++dx) {
            const double x = p.x + dx, y = p.y + dy;
            sum += std::abs(at(from, x, y) - at(to, x + flow.x, y + flow.y));
        }
    }
    return sum / kPatchPixels;
}

std::optional<glm::dvec2> track(const Pyramid& from, const Pyramid& to, const glm::dvec2& p) {
    glm::dvec2 flow{};
    for (std::size_t level = from.size(); level-- > 0;) {
        const glm::dvec2 at_level = std::ldexp(1.0, -static_cast<int>(level)) * p;
        flow *= level + 1 < from.size() ? 2.0 : 1.0;
        if (!refine(Patch(from[level], at_level), to[level], at_level, flow)) return std::nullopt;
    }
    return flow;
}

}  // namespace

std::vector<PointFlow> point_flow(const Image<std::uint8_t>& from, const Image<std::uint8_t>& to,
                                  const Image<std::uint8_t>& region) {
    RS_CHECK(from.width() == to.width() && from.height() == to.height());
    RS_CHECK(from.width() == region.width() && from.height() == region.height());
    const Pyramid first = pyramid_of(from), second = pyramid_of(to);
    std::vector<PointFlow> flows;
    for (int y = kRadius_px + 1; y + kRadius_px + 1 < from.height(); y += kGrid_px) {
        for (int x = kRadius_px + 1; x + kRadius_px + 1 < from.width(); x += kGrid_px) {
            if (region(x, y) == 0) continue;
            const glm::dvec2 p(x, y);
            if (patch_difference(first[0], second[0], p, {}) < kStaticDifference) continue;
            if (Patch(first[0], p).smaller_eigenvalue() < kLeastEigenvalue * kPatchPixels) continue;
            const std::optional<glm::dvec2> flow = track(first, second, p);
            if (!flow || patch_difference(first[0], second[0], p, *flow) > kMostDifference) continue;
            const std::optional<glm::dvec2> back = track(second, first, p + *flow);
            if (!back || glm::length(*flow + *back) > kMostReturnError_px) continue;
            flows.push_back({p, *flow});
        }
    }
    return flows;
}

}  // namespace rs::capture
