#include "capture/photos/matte/band_sides.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rs::capture {
namespace {

constexpr std::size_t kMoments = 12;  // 1, r, g, b, rr, rg, rb, gg, gb, bb; two more, so that four go at a time
using MomentRow = std::array<float, kMoments>;

// Of one place: of the object's pixels around it, and of the backdrop's.
struct BothSides {
    std::array<MomentRow, 2> of{};
};

void add_scaled(MomentRow& sum, const MomentRow& more, float by) {
    for (std::size_t k = 0; k < kMoments; ++k) sum[k] += by * more[k];
}

// A pixel's own moments times its trust, and the side it is of.
struct OwnMoments {
    MomentRow of{};
    std::size_t side = 0;
};

OwnMoments own_moments(const cv::Vec3f& colour, float distance_px, int band_px) {
    const float weight = trust(distance_px, band_px);
    const float r = weight * colour[0], g = weight * colour[1], b = weight * colour[2];
    return {{weight, r, g, b, r * colour[0], r * colour[1], r * colour[2], g * colour[1], g * colour[2], b * colour[2]},
            distance_px > 0 ? std::size_t{0} : std::size_t{1}};
}

Side side_from(const MomentRow& sums) {
    Side side;
    if (!(sums[0] > 1e-6F)) return side;
    std::array<float, 10> m{};
    for (std::size_t k = 1; k < m.size(); ++k) m[k] = sums[k] / sums[0];
    side.mean = {m[1], m[2], m[3]};
    side.covariance = {m[4] - m[1] * m[1], m[5] - m[1] * m[2], m[6] - m[1] * m[3],
                       m[7] - m[2] * m[2], m[8] - m[2] * m[3], m[9] - m[3] * m[3]};
    return side;
}

int mirrored(int at, int count) {
    if (count == 1) return 0;
    while (at < 0 || at >= count) at = at < 0 ? -at : 2 * (count - 1) - at;
    return at;
}

// Sums along rows, for as many rows as a window is tall.
class RowSums {
public:
    RowSums(const cv::Mat3f& light, const cv::Mat1f& distance, int band_px)
        : light_(light), distance_(distance), band_px_(band_px) {
        const double sigma_px = band_px + 1.0;
        reach_ = static_cast<int>(std::ceil(4 * sigma_px));
        double sum = 0;
        for (int k = -reach_; k <= reach_; ++k) sum += std::exp(-0.5 * k * k / (sigma_px * sigma_px));
        for (int k = -reach_; k <= reach_; ++k) {
            kernel_.push_back(static_cast<float>(std::exp(-0.5 * k * k / (sigma_px * sigma_px)) / sum));
        }
        const int rows = std::min(light.rows, 2 * reach_ + 1);
        ring_.resize(static_cast<std::size_t>(rows), std::vector<BothSides>(static_cast<std::size_t>(light.cols)));
    }

    [[nodiscard]] int reach() const { return reach_; }

    // Takes up row y at the columns that `needed` names.
    void take(int y, const std::uint8_t* needed) {
        int first = 0, last = light_.cols - 1;
        while (first <= last && needed[first] == 0) ++first;
        while (last >= first && needed[last] == 0) --last;
        const std::size_t slot = static_cast<std::size_t>(y) % ring_.size();
        if (first > last) return;
        const int from = first - reach_;
        own_.resize(static_cast<std::size_t>(last + reach_ + 1 - from));
        for (std::size_t i = 0; i < own_.size(); ++i) {
            const int x = mirrored(from + static_cast<int>(i), light_.cols);
            own_[i] = own_moments(light_(y, x), distance_(y, x), band_px_);
        }
        for (int x = first; x <= last; ++x) {
            if (needed[x] == 0) continue;
            BothSides sum;
            const OwnMoments* const own = own_.data() + (x - first);
            for (std::size_t k = 0; k < kernel_.size(); ++k) add_scaled(sum.of[own[k].side], own[k].of, kernel_[k]);
            ring_[slot][static_cast<std::size_t>(x)] = sum;
        }
    }

    // The whole window's around (x, y), all rows of which have been taken up.
    [[nodiscard]] BothSides around(int x, int y) const {
        BothSides sum;
        for (int k = -reach_; k <= reach_; ++k) {
            const auto row = static_cast<std::size_t>(mirrored(y + k, light_.rows));
            const BothSides& there = ring_[row % ring_.size()][static_cast<std::size_t>(x)];
            const float by = kernel_[static_cast<std::size_t>(k + reach_)];
            add_scaled(sum.of[0], there.of[0], by);
            add_scaled(sum.of[1], there.of[1], by);
        }
        return sum;
    }

private:
    const cv::Mat3f& light_;
    const cv::Mat1f& distance_;
    int band_px_;
    int reach_ = 0;
    std::vector<float> kernel_;
    std::vector<std::vector<BothSides>> ring_;  // row y at y % size
    std::vector<OwnMoments> own_;
};

}  // namespace

float trust(float distance_px, int band_px) {
    constexpr float kMixed = 0.02F;
    const float depth = std::abs(distance_px) + 0.5F;
    if (depth <= 0.5F) return 0;
    const float own = std::min(depth, static_cast<float>(band_px + 1)) - 1;
    return kMixed + own * own;
}

void for_each_in_band(const cv::Mat3f& light, const cv::Mat1f& distance, int band_px,
                      const std::function<void(int x, int y, const Side& object, const Side& backdrop)>& visit) {
    cv::Mat1b in_band(light.size());
    for (int y = 0; y < light.rows; ++y) {
        for (int x = 0; x < light.cols; ++x) {
            in_band(y, x) = std::abs(distance(y, x)) < static_cast<float>(band_px) ? 255 : 0;
        }
    }
    RowSums sums(light, distance, band_px);
    cv::Mat1b needed;
    cv::dilate(in_band, needed, cv::getStructuringElement(cv::MORPH_RECT, {1, 2 * sums.reach() + 1}));
    for (int y = -sums.reach(); y < light.rows; ++y) {
        if (const int next = y + sums.reach(); next < light.rows) sums.take(next, needed[next]);
        if (y < 0) continue;
        for (int x = 0; x < light.cols; ++x) {
            if (in_band(y, x) == 0) continue;
            const BothSides around = sums.around(x, y);
            visit(x, y, side_from(around.of[0]), side_from(around.of[1]));
        }
    }
}

}  // namespace rs::capture
