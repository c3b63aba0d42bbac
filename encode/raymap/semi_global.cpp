#include "encode/raymap/semi_global.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace rs::encode {
namespace {

using Path = std::int16_t;
constexpr Path kBeyond = 8000;  // beside the first and the last level

// The costs of a path at the pixels of a column, level n at [n + 1], between two sentinels; and their minima. Levels
// that a pixel does not have stay beyond.
class PathCosts {
public:
    PathCosts(int pixels, int levels)
        : stride_(static_cast<std::size_t>(levels) + 2),
          costs_(static_cast<std::size_t>(pixels) * stride_, kBeyond),
          written_(static_cast<std::size_t>(pixels)),
          least_(static_cast<std::size_t>(pixels), 0) {}

    // Level 0.
    [[nodiscard]] const Path* at(int pixel) const {
        return costs_.data() + static_cast<std::size_t>(pixel) * stride_ + 1;
    }
    [[nodiscard]] Path least(int pixel) const { return least_[static_cast<std::size_t>(pixel)]; }

    // For the levels of a pixel of the column that comes next; what was there is gone. The first of them.
    Path* begin(int pixel, const PixelLevels& levels) {
        Path* const costs = costs_.data() + static_cast<std::size_t>(pixel) * stride_ + 1;
        PixelLevels& written = written_[static_cast<std::size_t>(pixel)];
        std::fill_n(costs + written.first, written.count, kBeyond);
        written = levels;
        return costs + levels.first;
    }
    void set_least(int pixel, Path least) { least_[static_cast<std::size_t>(pixel)] = least; }

private:
    std::size_t stride_;
    std::vector<Path> costs_;
    std::vector<PixelLevels> written_;
    std::vector<Path> least_;
};

// One step of a path: into `to`, and added to `sum`; all point to a pixel's first level.
Path step_path(const Path* from, Path least_from, const std::uint8_t* costs, Path small_step, Path large_step,
               int levels, Path* to, Path* sum) {
    Path least = kBeyond;
    const auto jump = static_cast<Path>(least_from + large_step);
    for (int n = 0; n < levels; ++n) {
        const auto beside = static_cast<Path>(std::min(from[n - 1], from[n + 1]) + small_step);
        const Path best = std::min(std::min(from[n], beside), jump);
        const auto cost = static_cast<Path>(costs[n] + best - least_from);
        to[n] = cost;
        sum[n] = static_cast<Path>(sum[n] + cost);
        least = std::min(least, cost);
    }
    return least;
}

Path begin_path(const std::uint8_t* costs, int levels, Path* to, Path* sum) {
    Path least = kBeyond;
    for (int n = 0; n < levels; ++n) {
        const auto cost = static_cast<Path>(costs[n]);
        to[n] = cost;
        sum[n] = static_cast<Path>(sum[n] + cost);
        least = std::min(least, cost);
    }
    return least;
}

class Matcher {
public:
    Matcher(const WorkView& view, const CostVolume& volume, const SmoothnessOptions& options)
        : view_(view), volume_(volume), options_(options), sums_(volume.costs.size(), 0) {}

    // Paths that run with (direction 1) or against (-1) the columns, and within a column.
    void sweep(int direction) {
        const ObjectBox& box = volume_.box;
        const int rows = box.height();
        constexpr int kSlopes = 3;  // the previous column's row above, the same, below
        std::vector<PathCosts> before(kSlopes, PathCosts(rows, volume_.levels));
        std::vector<PathCosts> now(kSlopes, PathCosts(rows, volume_.levels));
        PathCosts within(rows, volume_.levels);
        for (int n = 0; n < box.width(); ++n) {
            const int column = direction > 0 ? box.left + n : box.right - 1 - n;
            for (int m = 0; m < rows; ++m) {
                const int r = direction > 0 ? m : rows - 1 - m;
                const int row = box.top + r;
                if (volume_.of(column, row).count == 0) continue;
                for (int slope = 0; slope < kSlopes; ++slope) {
                    const auto s = static_cast<std::size_t>(slope);
                    follow(before[s], r + slope - 1, column - direction, now[s], r, column);
                }
                follow(within, r - direction, column, within, r, column);
            }
            std::swap(before, now);
        }
    }

    [[nodiscard]] float level_of(const PixelLevels& pixel) const {
        const Path* const sum = sums_.data() + pixel.begin;
        const int best = static_cast<int>(std::min_element(sum, sum + pixel.count) - sum);
        const int level = pixel.first + best;
        if (best == 0 || best == pixel.count - 1) return static_cast<float>(level);
        // The vertex of the parabola through the three sums.
        const double before = sum[best - 1] - sum[best];
        const double after = sum[best + 1] - sum[best];
        const double curvature = before + after;
        return static_cast<float>(level + (curvature > 0 ? (before - after) / (2 * curvature) : 0));
    }

private:
    void follow(const PathCosts& from, int from_r, int from_column, PathCosts& to, int r, int column) {
        const ObjectBox& box = volume_.box;
        const int row = box.top + r;
        const PixelLevels& pixel = volume_.of(column, row);
        const std::uint8_t* const costs = volume_.costs.data() + pixel.begin;
        Path* const sum = sums_.data() + pixel.begin;
        Path* const here = to.begin(r, pixel);
        const bool begins = from_r < 0 || from_r >= box.height() || from_column < box.left ||
                            from_column >= box.right || volume_.of(from_column, box.top + from_r).count == 0;
        if (begins) {
            to.set_least(r, begin_path(costs, pixel.count, here, sum));
            return;
        }
        const Rgba8 own = view_.at(column, row);
        const Rgba8 there = view_.at(from_column, box.top + from_r);
        const int edge = std::abs(own.r - there.r) + std::abs(own.g - there.g) + std::abs(own.b - there.b);
        const int large = std::max(options_.small_step + 2, options_.large_step * 24 / (24 + edge));
        to.set_least(
            r, step_path(from.at(from_r) + pixel.first, from.least(from_r), costs,
                         static_cast<Path>(options_.small_step), static_cast<Path>(large), pixel.count, here, sum));
    }

    const WorkView& view_;
    const CostVolume& volume_;
    SmoothnessOptions options_;
    std::vector<Path> sums_;
};

}  // namespace

Image<float> semi_global_levels(const WorkView& view, const CostVolume& volume, const SmoothnessOptions& options) {
    Image<float> levels(view.height, view.width, kNoDepth);
    if (volume.box.empty()) return levels;
    Matcher matcher(view, volume, options);
    matcher.sweep(1);
    matcher.sweep(-1);
    for (int column = volume.box.left; column < volume.box.right; ++column) {
        for (int row = volume.box.top; row < volume.box.bottom; ++row) {
            const PixelLevels& pixel = volume.of(column, row);
            if (pixel.count > 0) levels(row, column) = matcher.level_of(pixel);
        }
    }
    return levels;
}

}  // namespace rs::encode
