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
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#ifndef RS_ENCODE_SEMI_GLOBAL_ONCE
#define RS_ENCODE_SEMI_GLOBAL_ONCE
namespace rs::encode {

using PathCost = std::int16_t;

// State shared by both sweeps over a volume. Vectors may read up to `kLanes` beyond the end of an array.
struct Paths {
    static constexpr int kLanes = 32;

    Paths(const WorkView& of_view, const CostVolume& of_volume, const SmoothnessOptions& options)
        : view(of_view), volume(of_volume), small_step(static_cast<PathCost>(options.small_step)) {
        const std::size_t count = volume.costs.size();
        last_begin_ = count - std::min(count, static_cast<std::size_t>(volume.levels + kLanes));
        last_.assign(volume.costs.begin() + static_cast<std::ptrdiff_t>(last_begin_), volume.costs.end());
        last_.resize(last_.size() + kLanes);
        sums.resize(count + kLanes);
        for (std::size_t edge = 0; edge < large_steps.size(); ++edge) {
            large_steps[edge] = static_cast<PathCost>(
                std::max(options.small_step + 2, options.large_step * 24 / (24 + static_cast<int>(edge))));
        }
    }

    // The costs of a pixel's levels, readable to the end of the last vector.
    [[nodiscard]] const std::uint8_t* costs(const PixelLevels& pixel) const {
        return pixel.begin < last_begin_ ? volume.costs.data() + pixel.begin
                                         : last_.data() + (pixel.begin - last_begin_);
    }

    const WorkView& view;
    const CostVolume& volume;
    PathCost small_step;
    std::array<PathCost, 3 * 255 + 1> large_steps;  // penalty P2, by the difference of two pixels' colours
    std::vector<PathCost> sums;                     // over all paths, for each level of the volume

private:
    std::size_t last_begin_;
    std::vector<std::uint8_t> last_;  // the volume's costs from last_begin_, padded
};

}  // namespace rs::encode
#endif

HWY_BEFORE_NAMESPACE();
namespace rs::encode::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<PathCost, Paths::kLanes>;
constexpr PathCost kBeyond = 8000;  // beside the first and the last level

// The costs of several paths at the pixels of a column, each between two sentinels, and their minima. Levels that a
// pixel does not have hold kBeyond. Paths begin where there is no pixel, also above and below the column: all costs are
// 0 there.
class PathCosts {
public:
    PathCosts(int paths, int pixels, int levels)
        : paths_(static_cast<std::size_t>(paths)),
          stride_(static_cast<std::size_t>(levels + 2 + Paths::kLanes)),
          costs_(static_cast<std::size_t>(pixels) * paths_ * stride_, kBeyond),
          written_(static_cast<std::size_t>(pixels)),
          nothing_(stride_, 0),
          from_(static_cast<std::size_t>(pixels + 2), {nothing_.data() + 1, 0}),
          least_(static_cast<std::size_t>(pixels + 2) * paths_, 0) {}
    // Not copyable: it points into its own storage.
    PathCosts(PathCosts&&) = default;
    PathCosts& operator=(PathCosts&&) = default;

    // Costs from level 0, and their minimum; -1 <= pixel <= number of pixels.
    [[nodiscard]] const PathCost* at(int path, int pixel) const {
        const From& from = from_[static_cast<std::size_t>(pixel + 1)];
        return from.costs + static_cast<std::size_t>(path) * from.stride;
    }
    [[nodiscard]] PathCost least(int path, int pixel) const {
        return least_[static_cast<std::size_t>(pixel + 1) * paths_ + static_cast<std::size_t>(path)];
    }

    // Marks a pixel of the next column as empty.
    void clear(int pixel) {
        from_[static_cast<std::size_t>(pixel + 1)] = {nothing_.data() + 1, 0};
        for (std::size_t path = 0; path < paths_; ++path) set_least(static_cast<int>(path), pixel, 0);
    }
    // Starts a pixel of the next column with these levels; each path then writes from to(path, pixel) + levels.first.
    void begin(int pixel, const PixelLevels& levels) {
        PathCost* const costs = to(0, pixel);
        from_[static_cast<std::size_t>(pixel + 1)] = {costs, stride_};
        const PixelLevels was = std::exchange(written_[static_cast<std::size_t>(pixel)], levels);
        const int end = levels.first + levels.count;
        const int was_end = was.first + was.count;
        for (std::size_t path = 0; path < paths_; ++path) {
            PathCost* const of_path = costs + path * stride_;
            for (int n = was.first; n < std::min<int>(was_end, levels.first); ++n) of_path[n] = kBeyond;
            for (int n = std::max<int>(was.first, end); n < was_end; ++n) of_path[n] = kBeyond;
        }
    }
    [[nodiscard]] PathCost* to(int path, int pixel) {
        return costs_.data() + (static_cast<std::size_t>(pixel) * paths_ + static_cast<std::size_t>(path)) * stride_ +
               1;
    }
    void set_least(int path, int pixel, PathCost least) {
        least_[static_cast<std::size_t>(pixel + 1) * paths_ + static_cast<std::size_t>(path)] = least;
    }

private:
    struct From {
        const PathCost* costs = nullptr;  // of the first path
        std::size_t stride = 0;           // to the next
    };
    std::size_t paths_;
    std::size_t stride_;
    std::vector<PathCost> costs_;       // [(pixel * paths + path) * stride + 1 + level]
    std::vector<PixelLevels> written_;  // [pixel]
    std::vector<PathCost> nothing_;
    std::vector<From> from_;       // [pixel + 1]
    std::vector<PathCost> least_;  // [(pixel + 1) * paths + path]
};

// One step of a path: its costs at the previous pixel, from the first level of the next pixel, with their minimum; and
// the costs at the next pixel.
struct Step {
    const PathCost* from = nullptr;
    PathCost least_from = 0;
    PathCost large_step = 0;
    PathCost* to = nullptr;
    PathCost least = kBeyond;
};

constexpr int kPaths = 4;  // of each sweep, per pixel

// 0, 1, 2 ...
HWY_INLINE auto lane_numbers() {
    alignas(2 * Paths::kLanes) static constexpr PathCost kNumbers[Paths::kLanes] = {
        0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15,
        16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31};
    return hn::Load(Lanes(), kNumbers);
}

// Steps all paths to one pixel with matching costs `costs`, and adds their costs to `sum`.
HWY_INLINE void step_paths(const std::uint8_t* costs, int levels, PathCost small_step, Step* steps, PathCost* sum) {
    const Lanes d;
    const hn::Rebind<std::uint8_t, Lanes> bytes;
    const auto numbers = lane_numbers();
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

// Sums of absolute colour differences; a plain loop, for auto-vectorization.
void measure_edges(const Rgba8* a, const Rgba8* b, int count, std::uint16_t* edges) {
    for (int n = 0; n < count; ++n) {
        std::uint32_t one = 0, other = 0;
        std::memcpy(&one, a + n, sizeof one);
        std::memcpy(&other, b + n, sizeof other);
        const auto difference = [&](int shift) {
            return std::abs(static_cast<int>((one >> shift) & 255U) - static_cast<int>((other >> shift) & 255U));
        };
        edges[n] = static_cast<std::uint16_t>(difference(0) + difference(8) + difference(16));
    }
}

class Sweep {
public:
    Sweep(Paths& paths, int direction)
        : paths_(paths),
          box_(paths.volume.box),
          direction_(direction),
          edges_(kPaths, std::vector<std::uint16_t>(static_cast<std::size_t>(box_.height()))) {}

    void run() {
        const int rows = box_.height();
        PathCosts before(kSlopes, rows, paths_.volume.levels);
        PathCosts now(kSlopes, rows, paths_.volume.levels);
        PathCosts within(1, rows, paths_.volume.levels);
        for (int n = 0; n < box_.width(); ++n) {
            const int column = direction_ > 0 ? box_.left + n : box_.right - 1 - n;
            find_edges(column, n == 0 ? column : column - direction_);
            for (int m = 0; m < rows; ++m) {
                const int r = direction_ > 0 ? m : rows - 1 - m;
                const PixelLevels& pixel = paths_.volume.of(column, box_.top + r);
                if (pixel.count == 0) {
                    now.clear(r);
                    within.clear(r);
                    continue;
                }
                now.begin(r, pixel);
                within.begin(r, pixel);
                std::array<Step, kPaths> steps;
                for (int slope = 0; slope < kSlopes; ++slope) {
                    steps[static_cast<std::size_t>(slope)] =
                        step(before, slope, r + slope - 1, large_step(slope, r), now.to(slope, r), pixel);
                }
                steps[kSlopes] = step(within, 0, r - direction_, large_step(kSlopes, r), within.to(0, r), pixel);
                step_paths(paths_.costs(pixel), pixel.count, paths_.small_step, steps.data(),
                           paths_.sums.data() + pixel.begin);
                for (int slope = 0; slope < kSlopes; ++slope) {
                    now.set_least(slope, r, steps[static_cast<std::size_t>(slope)].least);
                }
                within.set_least(0, r, steps[kSlopes].least);
            }
            std::swap(before, now);
        }
    }

private:
    static constexpr int kSlopes = kPaths - 1;  // the previous column's row above, the same, below

    HWY_INLINE static Step step(const PathCosts& costs, int path, int from_r, PathCost large_step, PathCost* to,
                                const PixelLevels& pixel) {
        return {.from = costs.at(path, from_r) + pixel.first,
                .least_from = costs.least(path, from_r),
                .large_step = large_step,
                .to = to + pixel.first};
    }

    [[nodiscard]] PathCost large_step(int path, int r) const {
        return paths_.large_steps[edges_[static_cast<std::size_t>(path)][static_cast<std::size_t>(r)]];
    }

    // Colour differences along each path into a column; 0 where a path enters from above or below the box.
    void find_edges(int column, int from_column) {
        const Rgba8* const own = &paths_.view.at(column, box_.top);
        const Rgba8* const there = &paths_.view.at(from_column, box_.top);
        const int most = box_.height() - 1;
        measure_edges(own + 1, there, most, edges_[0].data() + 1);
        measure_edges(own, there, most + 1, edges_[1].data());
        measure_edges(own, there + 1, most, edges_[2].data());
        measure_edges(own + 1, own, most, edges_[kSlopes].data() + (direction_ > 0 ? 1 : 0));
    }

    Paths& paths_;
    const ObjectBox& box_;
    int direction_;
    std::vector<std::vector<std::uint16_t>> edges_;  // [path][row - top]
};

// Runs the paths in (1) or against (-1) the order of the columns, and within each column.
void sweep(Paths& paths, int direction) {
    Sweep(paths, direction).run();
}

// The index of the first minimum of `count` sums, which are readable to the end of the last vector.
int first_least(const PathCost* sums, int count) {
    const Lanes d;
    const auto numbers = lane_numbers();
    const auto most = hn::Set(d, std::numeric_limits<PathCost>::max());
    const auto at = [&](int n) {
        const auto has = hn::Lt(numbers, hn::Set(d, static_cast<PathCost>(count - n)));
        return hn::IfThenElse(has, hn::LoadU(d, sums + n), most);
    };
    const int lanes = static_cast<int>(hn::Lanes(d));
    auto least = most;
    for (int n = 0; n < count; n += lanes) least = hn::Min(least, at(n));
    least = hn::MinOfLanes(d, least);
    for (int n = 0;; n += lanes) {
        const auto found = hn::FindFirstTrue(d, hn::Eq(at(n), least));
        if (found >= 0) return n + static_cast<int>(found);
    }
}

float level_of(const PixelLevels& pixel, const PathCost* sum) {
    const int best = first_least(sum, pixel.count);
    const int level = pixel.first + best;
    if (best == 0 || best == pixel.count - 1) return static_cast<float>(level);
    // The vertex of the parabola through the three sums.
    const double before = sum[best - 1] - sum[best];
    const double after = sum[best + 1] - sum[best];
    const double curvature = before + after;
    return static_cast<float>(level + (curvature > 0 ? (before - after) / (2 * curvature) : 0));
}

// Writes levels(row, column) of the pixels that have levels.
void find_levels(const Paths& paths, Image<float>& levels) {
    const ObjectBox& box = paths.volume.box;
    for (int column = box.left; column < box.right; ++column) {
        for (int row = box.top; row < box.bottom; ++row) {
            const PixelLevels& pixel = paths.volume.of(column, row);
            if (pixel.count > 0) levels(row, column) = level_of(pixel, paths.sums.data() + pixel.begin);
        }
    }
}

}  // namespace rs::encode::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rs::encode {

HWY_EXPORT(sweep);
HWY_EXPORT(find_levels);

Image<float> semi_global_levels(const WorkView& view, const CostVolume& volume, const SmoothnessOptions& options) {
    Image<float> levels(view.height, view.width, kNoDepth);
    if (volume.box.empty()) return levels;
    Paths paths(view, volume, options);
    HWY_DYNAMIC_DISPATCH(sweep)(paths, 1);
    HWY_DYNAMIC_DISPATCH(sweep)(paths, -1);
    HWY_DYNAMIC_DISPATCH(find_levels)(paths, levels);
    return levels;
}

}  // namespace rs::encode
#endif  // HWY_ONCE
