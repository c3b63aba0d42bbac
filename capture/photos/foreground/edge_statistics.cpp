#include "capture/photos/foreground/edge_statistics.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rs::capture {
namespace {

constexpr std::size_t kMoments = 12;  // 1, r, g, b, rr, rg, rb, gg, gb, bb; padded to a multiple of 4 for SIMD
using Moments = std::array<float, kMoments>;

enum Side : std::size_t { kForeground, kBackground };

// Weighted sums over a window, [Side].
using SideMoments = std::array<Moments, 2>;

void add_scaled(Moments& sum, const Moments& moments, float factor) {
    for (std::size_t k = 0; k < kMoments; ++k) sum[k] += factor * moments[k];
}

struct PixelMoments {
    Moments moments{};  // times purity_weight()
    Side side = kForeground;
};

PixelMoments pixel_moments(const cv::Vec3f& colour, float distance_px, int band_px, float mixed_weight) {
    const float weight = purity_weight(distance_px, band_px, mixed_weight);
    const float r = weight * colour[0], g = weight * colour[1], b = weight * colour[2];
    return {{weight, r, g, b, r * colour[0], r * colour[1], r * colour[2], g * colour[1], g * colour[2], b * colour[2]},
            distance_px > 0 ? kForeground : kBackground};
}

ColourStatistics statistics_from(const Moments& sums) {
    ColourStatistics side;
    if (!(sums[0] > 1e-6F)) return side;
    std::array<float, 10> m{};
    for (std::size_t k = 1; k < m.size(); ++k) m[k] = sums[k] / sums[0];
    side.mean = {m[1], m[2], m[3]};
    side.covariance = {m[4] - m[1] * m[1], m[5] - m[1] * m[2], m[6] - m[1] * m[3],
                       m[7] - m[2] * m[2], m[8] - m[2] * m[3], m[9] - m[3] * m[3]};
    return side;
}

// Index `at` of a sequence of `count` values that is mirrored at both ends (BORDER_REFLECT_101).
int mirrored(int at, int count) {
    if (count == 1) return 0;
    while (at < 0 || at >= count) at = at < 0 ? -at : 2 * (count - 1) - at;
    return at;
}

// Separable Gaussian filter of the moments. Keeps the horizontally filtered rows of one window height in a ring buffer.
class MomentFilter {
public:
    MomentFilter(const cv::Mat3f& light, const cv::Mat1f& distance, int band_px, float mixed_weight)
        : light_(light), distance_(distance), band_px_(band_px), mixed_weight_(mixed_weight) {
        const double sigma_px = band_px + 1.0;
        reach_ = static_cast<int>(std::ceil(4 * sigma_px));
        double sum = 0;
        for (int k = -reach_; k <= reach_; ++k) sum += std::exp(-0.5 * k * k / (sigma_px * sigma_px));
        for (int k = -reach_; k <= reach_; ++k) {
            kernel_.push_back(static_cast<float>(std::exp(-0.5 * k * k / (sigma_px * sigma_px)) / sum));
        }
        const int rows = std::min(light.rows, 2 * reach_ + 1);
        ring_.resize(static_cast<std::size_t>(rows), std::vector<SideMoments>(static_cast<std::size_t>(light.cols)));
    }

    // Half height of the window, px.
    [[nodiscard]] int reach() const { return reach_; }

    // Filters row y horizontally in the columns where `needed` is not 0. Rows must be added in order.
    void add_row(int y, const std::uint8_t* needed) {
        int first = 0, last = light_.cols - 1;
        while (first <= last && needed[first] == 0) ++first;
        while (last >= first && needed[last] == 0) --last;
        const std::size_t slot = static_cast<std::size_t>(y) % ring_.size();
        if (first > last) return;
        const int from = first - reach_;
        pixels_.resize(static_cast<std::size_t>(last + reach_ + 1 - from));
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            const int x = mirrored(from + static_cast<int>(i), light_.cols);
            pixels_[i] = pixel_moments(light_(y, x), distance_(y, x), band_px_, mixed_weight_);
        }
        for (int x = first; x <= last; ++x) {
            if (needed[x] == 0) continue;
            SideMoments sum{};
            const PixelMoments* const pixel = pixels_.data() + (x - first);
            for (std::size_t k = 0; k < kernel_.size(); ++k) {
                add_scaled(sum[pixel[k].side], pixel[k].moments, kernel_[k]);
            }
            ring_[slot][static_cast<std::size_t>(x)] = sum;
        }
    }

    // Sums over the window around (x, y). All its rows must have been added.
    [[nodiscard]] SideMoments at(int x, int y) const {
        SideMoments sum{};
        for (int k = -reach_; k <= reach_; ++k) {
            const auto row = static_cast<std::size_t>(mirrored(y + k, light_.rows));
            const SideMoments& filtered = ring_[row % ring_.size()][static_cast<std::size_t>(x)];
            const float factor = kernel_[static_cast<std::size_t>(k + reach_)];
            add_scaled(sum[kForeground], filtered[kForeground], factor);
            add_scaled(sum[kBackground], filtered[kBackground], factor);
        }
        return sum;
    }

private:
    const cv::Mat3f& light_;
    const cv::Mat1f& distance_;
    int band_px_;
    float mixed_weight_;
    int reach_ = 0;
    std::vector<float> kernel_;
    std::vector<std::vector<SideMoments>> ring_;  // [y % size], filtered rows
    std::vector<PixelMoments> pixels_;
};

}  // namespace

float purity_weight(float distance_px, int band_px, float mixed_weight) {
    const float depth = std::abs(distance_px) + 0.5F;
    if (depth <= 0.5F) return 0;
    const float inner = std::min(depth, static_cast<float>(band_px + 1)) - 1;
    return mixed_weight + inner * inner;
}

void for_each_band_pixel(const cv::Mat3f& light, const cv::Mat1f& distance, int band_px, float mixed_weight,
                         const std::function<void(int x, int y, const ColourStatistics& foreground,
                                                  const ColourStatistics& background)>& visit) {
    cv::Mat1b in_band(light.size());
    for (int y = 0; y < light.rows; ++y) {
        for (int x = 0; x < light.cols; ++x) {
            in_band(y, x) = std::abs(distance(y, x)) < static_cast<float>(band_px) ? 255 : 0;
        }
    }
    MomentFilter filter(light, distance, band_px, mixed_weight);
    cv::Mat1b needed;
    cv::dilate(in_band, needed, cv::getStructuringElement(cv::MORPH_RECT, {1, 2 * filter.reach() + 1}));
    for (int y = -filter.reach(); y < light.rows; ++y) {
        if (const int next = y + filter.reach(); next < light.rows) filter.add_row(next, needed[next]);
        if (y < 0) continue;
        for (int x = 0; x < light.cols; ++x) {
            if (in_band(y, x) == 0) continue;
            const SideMoments moments = filter.at(x, y);
            visit(x, y, statistics_from(moments[kForeground]), statistics_from(moments[kBackground]));
        }
    }
}

}  // namespace rs::capture
