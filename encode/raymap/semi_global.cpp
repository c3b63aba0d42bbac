#include "encode/raymap/semi_global.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encode/raymap/semi_global.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#ifndef RS_ENCODE_SEMI_GLOBAL_ONCE
#define RS_ENCODE_SEMI_GLOBAL_ONCE
namespace rs::encode {

using PathCost = std::int16_t;

// What both sweeps over a volume share. Vectors reach `kLanes` beyond what they are of, but change nothing there.
struct Paths {
    static constexpr int kLanes = 16;

    Paths(const WorkView& of_view, const CostVolume& of_volume, const SmoothnessOptions& options)
        : view(of_view), volume(of_volume), small_step(static_cast<PathCost>(options.small_step)) {
        costs = volume.costs;
        costs.resize(costs.size() + kLanes);
        sums.resize(costs.size());
        for (std::size_t edge = 0; edge < large_steps.size(); ++edge) {
            large_steps[edge] = static_cast<PathCost>(
                std::max(options.small_step + 2, options.large_step * 24 / (24 + static_cast<int>(edge))));
        }
    }

    const WorkView& view;
    const CostVolume& volume;
    PathCost small_step;
    std::array<PathCost, 3 * 255 + 1> large_steps;  // by how much two pixels' colours differ
    std::vector<std::uint8_t> costs;                // those of the volume
    std::vector<PathCost> sums;                     // of the paths' costs at each of them
};

}  // namespace rs::encode
#endif

HWY_BEFORE_NAMESPACE();
namespace rs::encode::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<PathCost, Paths::kLanes>;
constexpr PathCost kBeyond = 8000;  // beside the first and the last level

// The costs of a path at the pixels of a column, between two sentinels; and their minima. Levels that a pixel does not
// have stay beyond.
class PathCosts {
public:
    PathCosts(int pixels, int levels)
        : stride_(static_cast<std::size_t>(levels + 2 + Paths::kLanes)),
          costs_(static_cast<std::size_t>(pixels) * stride_, kBeyond),
          written_(static_cast<std::size_t>(pixels)),
          least_(static_cast<std::size_t>(pixels), 0) {}

    // Level 0.
    [[nodiscard]] const PathCost* at(int pixel) const {
        return costs_.data() + static_cast<std::size_t>(pixel) * stride_ + 1;
    }
    [[nodiscard]] PathCost least(int pixel) const { return least_[static_cast<std::size_t>(pixel)]; }

    // For the levels of a pixel of the column that comes next; what was there is gone. The first of them.
    PathCost* begin(int pixel, const PixelLevels& levels) {
        PathCost* const costs = costs_.data() + static_cast<std::size_t>(pixel) * stride_ + 1;
        PixelLevels& written = written_[static_cast<std::size_t>(pixel)];
        std::fill_n(costs + written.first, written.count, kBeyond);
        written = levels;
        return costs + levels.first;
    }
    void set_least(int pixel, PathCost least) { least_[static_cast<std::size_t>(pixel)] = least; }

private:
    std::size_t stride_;
    std::vector<PathCost> costs_;
    std::vector<PixelLevels> written_;
    std::vector<PathCost> least_;
};

// Where a path comes from: its costs there at the first level of the pixel that it steps to, and their minimum; and
// where it goes.
struct Step {
    const PathCost* from = nullptr;
    PathCost least_from = 0;
    PathCost large_step = 0;
    PathCost* to = nullptr;
    PathCost least = kBeyond;
};

constexpr int kPaths = 4;  // that a sweep follows to each pixel

// All paths' steps to one pixel, whose levels cost `costs`; added to `sum`.
HWY_INLINE void step_paths(const std::uint8_t* costs, int levels, PathCost small_step, Step* steps, PathCost* sum) {
    const Lanes d;
    const hn::Rebind<std::uint8_t, Lanes> bytes;
    alignas(2 * Paths::kLanes) static constexpr PathCost kNumbers[Paths::kLanes] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                                                    8, 9, 10, 11, 12, 13, 14, 15};
    const auto numbers = hn::Load(d, kNumbers);
    const auto beyond = hn::Set(d, kBeyond);
    const auto small = hn::Set(d, small_step);
    auto least0 = beyond, least1 = beyond, least2 = beyond, least3 = beyond;
    for (int n = 0; n < levels; n += static_cast<int>(hn::Lanes(d))) {
        const auto has = hn::Lt(numbers, hn::Set(d, static_cast<PathCost>(levels - n)));
        const auto own = hn::PromoteTo(d, hn::LoadU(bytes, costs + n));
        auto all = hn::LoadU(d, sum + n);
        const auto follow = [&](const Step& step, auto& least) {
            const PathCost* const from = step.from + n;
            const auto beside = hn::Add(hn::Min(hn::LoadU(d, from - 1), hn::LoadU(d, from + 1)), small);
            const auto jump = hn::Set(d, static_cast<PathCost>(step.least_from + step.large_step));
            const auto best = hn::Min(hn::Min(hn::LoadU(d, from), beside), jump);
            const auto cost = hn::IfThenElse(has, hn::Add(own, hn::Sub(best, hn::Set(d, step.least_from))), beyond);
            hn::StoreU(cost, d, step.to + n);
            all = hn::Add(all, hn::IfThenElseZero(has, cost));
            least = hn::Min(least, cost);
        };
        follow(steps[0], least0);
        follow(steps[1], least1);
        follow(steps[2], least2);
        follow(steps[3], least3);
        hn::StoreU(all, d, sum + n);
    }
    steps[0].least = hn::GetLane(hn::MinOfLanes(d, least0));
    steps[1].least = hn::GetLane(hn::MinOfLanes(d, least1));
    steps[2].least = hn::GetLane(hn::MinOfLanes(d, least2));
    steps[3].least = hn::GetLane(hn::MinOfLanes(d, least3));
}

class Sweep {
public:
    Sweep(Paths& paths, int direction)
        : paths_(paths),
          box_(paths.volume.box),
          direction_(direction),
          nothing_(static_cast<std::size_t>(paths.volume.levels + 2 + Paths::kLanes), 0) {}

    void run() {
        const int rows = box_.height();
        constexpr int kSlopes = kPaths - 1;  // the previous column's row above, the same, below
        std::vector<PathCosts> before(kSlopes, PathCosts(rows, paths_.volume.levels));
        std::vector<PathCosts> now(kSlopes, PathCosts(rows, paths_.volume.levels));
        PathCosts within(rows, paths_.volume.levels);
        for (int n = 0; n < box_.width(); ++n) {
            const int column = direction_ > 0 ? box_.left + n : box_.right - 1 - n;
            for (int m = 0; m < rows; ++m) {
                const int r = direction_ > 0 ? m : rows - 1 - m;
                const PixelLevels& pixel = paths_.volume.of(column, box_.top + r);
                if (pixel.count == 0) continue;
                std::array<Step, kPaths> steps;
                for (std::size_t slope = 0; slope < kSlopes; ++slope) {
                    steps[slope] = step_from(before[slope], r + static_cast<int>(slope) - 1, column - direction_, r,
                                             column, pixel);
                    steps[slope].to = now[slope].begin(r, pixel);
                }
                steps[kSlopes] = step_from(within, r - direction_, column, r, column, pixel);
                steps[kSlopes].to = within.begin(r, pixel);
                step_paths(paths_.costs.data() + pixel.begin, pixel.count, paths_.small_step, steps.data(),
                           paths_.sums.data() + pixel.begin);
                for (std::size_t slope = 0; slope < kSlopes; ++slope) now[slope].set_least(r, steps[slope].least);
                within.set_least(r, steps[kSlopes].least);
            }
            std::swap(before, now);
        }
    }

private:
    // A path that begins at the pixel comes from where nothing costs anything.
    [[nodiscard]] HWY_INLINE Step step_from(const PathCosts& from, int from_r, int from_column, int r, int column,
                                            const PixelLevels& pixel) const {
        const bool begins = from_r < 0 || from_r >= box_.height() || from_column < box_.left ||
                            from_column >= box_.right || paths_.volume.of(from_column, box_.top + from_r).count == 0;
        if (begins) return {.from = nothing_.data() + 1};
        const Rgba8 own = paths_.view.at(column, box_.top + r);
        const Rgba8 there = paths_.view.at(from_column, box_.top + from_r);
        const int edge = std::abs(own.r - there.r) + std::abs(own.g - there.g) + std::abs(own.b - there.b);
        return {.from = from.at(from_r) + pixel.first,
                .least_from = from.least(from_r),
                .large_step = paths_.large_steps[static_cast<std::size_t>(edge)]};
    }

    Paths& paths_;
    const ObjectBox& box_;
    int direction_;
    std::vector<PathCost> nothing_;
};

// Paths that run with (direction 1) or against (-1) the columns, and within a column.
void sweep(Paths& paths, int direction) {
    Sweep(paths, direction).run();
}

}  // namespace rs::encode::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rs::encode {
namespace {

float level_of(const PixelLevels& pixel, const PathCost* sums) {
    const PathCost* const sum = sums + pixel.begin;
    const int best = static_cast<int>(std::min_element(sum, sum + pixel.count) - sum);
    const int level = pixel.first + best;
    if (best == 0 || best == pixel.count - 1) return static_cast<float>(level);
    // The vertex of the parabola through the three sums.
    const double before = sum[best - 1] - sum[best];
    const double after = sum[best + 1] - sum[best];
    const double curvature = before + after;
    return static_cast<float>(level + (curvature > 0 ? (before - after) / (2 * curvature) : 0));
}

}  // namespace

HWY_EXPORT(sweep);

Image<float> semi_global_levels(const WorkView& view, const CostVolume& volume, const SmoothnessOptions& options) {
    Image<float> levels(view.height, view.width, kNoDepth);
    if (volume.box.empty()) return levels;
    Paths paths(view, volume, options);
    HWY_DYNAMIC_DISPATCH(sweep)(paths, 1);
    HWY_DYNAMIC_DISPATCH(sweep)(paths, -1);
    for (int column = volume.box.left; column < volume.box.right; ++column) {
        for (int row = volume.box.top; row < volume.box.bottom; ++row) {
            const PixelLevels& pixel = volume.of(column, row);
            if (pixel.count > 0) levels(row, column) = level_of(pixel, paths.sums.data());
        }
    }
    return levels;
}

}  // namespace rs::encode
#endif  // HWY_ONCE
