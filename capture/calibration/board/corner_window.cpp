#include "capture/calibration/board/corner_window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace rs::capture {
namespace {

constexpr double kArm = 0.42;                 // arm length of the cross, in squares
constexpr double kMost = 0.2;                 // largest distance of the corner from its predicted position, in squares
constexpr double kCorrelation = 0.7;          // with an ideal chessboard
constexpr double kLeastSectorContrast = 0.4;  // of the two worst sectors, relative to the mean contrast
constexpr double kSmear_px = 3;
constexpr int kMostRefinements = 12;

struct Window {
    int half = 0;      // samples from the middle to the rim
    double pitch = 0;  // squares from sample to sample
    std::vector<float> grey;

    [[nodiscard]] float at(int x, int y) const {
        return grey[static_cast<std::size_t>((y + half) * (2 * half + 1) + x + half)];
    }
};

cv::Point2d apply_homography(const cv::Matx33d& h, double x, double y) {
    const cv::Vec3d p = h * cv::Vec3d(x, y, 1);
    return {p[0] / p[2], p[1] / p[2]};
}

// Samples the window around `centre` (in squares); false if it leaves the image.
bool sample_window(Window& window, const cv::Mat1f& grey, const cv::Matx33d& h, const glm::dvec2& centre) {
    const int n = 2 * window.half + 1;
    window.grey.resize(static_cast<std::size_t>(n * n));
    auto out = window.grey.begin();
    for (int y = -window.half; y <= window.half; ++y) {
        for (int x = -window.half; x <= window.half; ++x) {
            const cv::Point2d p = apply_homography(h, centre.x + x * window.pitch, centre.y + y * window.pitch);
            if (!(p.x >= 0 && p.y >= 0 && p.x < grey.cols - 1 && p.y < grey.rows - 1)) return false;
            const int x0 = static_cast<int>(p.x), y0 = static_cast<int>(p.y);
            const float fx = static_cast<float>(p.x - x0), fy = static_cast<float>(p.y - y0);
            const float* top = grey[y0] + x0;
            const float* bottom = grey[y0 + 1] + x0;
            *out++ = (1 - fy) * ((1 - fx) * top[0] + fx * top[1]) + fy * ((1 - fx) * bottom[0] + fx * bottom[1]);
        }
    }
    return true;
}

// True if the samples within `band` of the edges and those inside the black squares match a chessboard: as a whole, and
// in each of sixteen sectors, so that neither a missing square nor an object in front of part of an arm passes.
bool matches_chessboard(const Window& window, bool first_is_black, double band) {
    struct Sum {
        double n = 0, v = 0;
    };
    std::array<Sum, 16> sectors;
    double n = 0, sum = 0, sum2 = 0, sign_sum = 0, product = 0;
    for (int y = -window.half; y <= window.half; ++y) {
        for (int x = -window.half; x <= window.half; ++x) {
            if (x == 0 || y == 0) continue;
            const bool black = ((x > 0) == (y > 0)) == first_is_black;
            const int far = std::max(std::abs(x), std::abs(y));
            if (!black && std::min(std::abs(x), std::abs(y)) * window.pitch > band) continue;
            const double v = window.at(x, y);
            const double sign = black ? -1 : 1;
            n += 1, sum += v, sum2 += v * v, sign_sum += sign, product += sign * v;
            Sum& sector = sectors[static_cast<std::size_t>((x > 0 ? 1 : 0) + (y > 0 ? 2 : 0) +
                                                           (std::abs(x) > std::abs(y) ? 4 : 0) +
                                                           (2 * far > window.half ? 8 : 0))];
            sector.n += 1;
            sector.v += v;
        }
    }
    const double covariance = product / n - sum / n * (sign_sum / n);
    const double spread = (sum2 / n - sum / n * (sum / n)) * (1 - sign_sum / n * (sign_sum / n));
    if (!(spread > 1e-9 && covariance / std::sqrt(spread) > kCorrelation)) return false;
    double darkest_white = 1e9, lightest_black = -1e9, whites = 0, blacks = 0;
    for (std::size_t k = 0; k < sectors.size(); ++k) {
        const double mean = sectors[k].v / std::max(1.0, sectors[k].n);
        const bool on_diagonal = ((k & 1) != 0) == ((k & 2) != 0);
        if (on_diagonal == first_is_black) {
            lightest_black = std::max(lightest_black, mean);
            blacks += mean / 8;
        } else {
            darkest_white = std::min(darkest_white, mean);
            whites += mean / 8;
        }
    }
    return darkest_white - lightest_black > kLeastSectorContrast * (whites - blacks);
}

// Offset from the window's centre to the corner, in squares.
std::optional<glm::dvec2> corner_offset(const Window& window, double band) {
    double a = 0, b = 0, c = 0, u = 0, v = 0;
    for (int y = -window.half + 1; y < window.half; ++y) {
        for (int x = -window.half + 1; x < window.half; ++x) {
            const double px = x * window.pitch, py = y * window.pitch;
            if (std::min(std::abs(px), std::abs(py)) > band) continue;
            const double gx = window.at(x + 1, y) - window.at(x - 1, y);
            const double gy = window.at(x, y + 1) - window.at(x, y - 1);
            const double along = gx * px + gy * py;
            a += gx * gx, b += gx * gy, c += gy * gy;
            u += gx * along, v += gy * along;
        }
    }
    const double determinant = a * c - b * b;
    if (!(determinant > 1e-3 * a * c)) return std::nullopt;  // one edge only, or none
    return glm::dvec2((c * u - b * v) / determinant, (a * v - b * u) / determinant);
}

}  // namespace

std::optional<glm::dvec2> refine_corner(const cv::Mat1f& grey, const cv::Matx33d& h, bool first_is_black,
                                        double margin) {
    // The shorter edge in the image limits the resolution of a square.
    const double side_x = cv::norm(apply_homography(h, 0.5, 0) - apply_homography(h, -0.5, 0));
    const double side_y = cv::norm(apply_homography(h, 0, 0.5) - apply_homography(h, 0, -0.5));
    const double longest = std::max(side_x, side_y);
    if (!(std::isfinite(longest) && std::min(side_x, side_y) > 2)) return std::nullopt;
    Window window;
    window.half = std::clamp(static_cast<int>(std::lround(kArm * longest)), 8, 24);
    window.pitch = kArm / window.half;
    // Smoothing and differences blur a marker's edge by kSmear_px; the band excludes that much if space permits.
    const cv::Matx22d to_px{h(0, 0) / h(2, 2), h(0, 1) / h(2, 2), h(1, 0) / h(2, 2), h(1, 1) / h(2, 2)};
    const double narrow_px = std::abs(cv::determinant(to_px)) / longest;  // smallest height of a square in pixels
    const double band = std::clamp(margin - kSmear_px / std::max(1.0, narrow_px), 0.45 * margin, margin);

    glm::dvec2 centre(0);
    for (int i = 0; i < kMostRefinements; ++i) {
        if (!sample_window(window, grey, h, centre)) return std::nullopt;
        const auto step = corner_offset(window, band);
        if (!step) return std::nullopt;
        centre += *step;
        if (!(glm::length(centre) < kMost)) return std::nullopt;
        if (glm::length(*step) * longest < 2e-3) break;
    }
    if (!sample_window(window, grey, h, centre) || !matches_chessboard(window, first_is_black, band))
        return std::nullopt;
    const cv::Point2d p = apply_homography(h, centre.x, centre.y);
    return glm::dvec2(p.x, p.y);
}

}  // namespace rs::capture
