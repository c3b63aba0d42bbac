#include "encode/raymap/silhouettes/visual_hull.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace rs::encode {
namespace {

const double kReach = kMaxDepth * std::sqrt(2.0);  // radius that a sampled hull covers

// Sets near_object[row] where the object is at most `margin` columns away.
void widen_column(const WorkView& view, int column, int margin, std::vector<std::uint8_t>& near_object) {
    near_object.assign(static_cast<std::size_t>(view.height), 0);
    for (int c = std::max(0, column - margin); c <= std::min(view.width - 1, column + margin); ++c) {
        const Rgba8* const pixels = view.columns.row(c);
        std::uint8_t* const near = near_object.data();
        for (int row = 0; row < view.height; ++row) {
            near[row] = std::max<std::uint8_t>(near[row], pixels[row].a >= kInside ? 1 : 0);
        }
    }
}

// Appends the forbidden intervals of a column from widen_column().
void forbid_slopes(const WorkView& view, const std::vector<std::uint8_t>& near_object, int margin,
                   std::vector<Interval>& forbidden) {
    const auto slope_of = [&](double row) { return (view.cy - row) / view.fl_y; };
    const std::size_t first = forbidden.size();
    int begin = 0;
    for (int row = 0; row <= view.height; ++row) {
        const bool ends = row == view.height || near_object[static_cast<std::size_t>(row)] != 0;
        if (!ends) continue;
        // The edges of the frame are not edges of the object.
        const double low = begin == 0 ? 0 : begin + margin;
        const double high = row == view.height ? row : row - margin;
        if (high > low) forbidden.push_back({slope_of(high), slope_of(low)});
        begin = row + 1;
    }
    std::reverse(forbidden.begin() + static_cast<std::ptrdiff_t>(first), forbidden.end());  // rows count downwards
}

bool has_object(const WorkView& view) {
    const auto pixels = view.columns.pixels();
    return std::any_of(pixels.begin(), pixels.end(), [](const Rgba8& pixel) { return pixel.a >= kInside; });
}

// Subtracts [low, high] from ascending, disjoint intervals, of which those before `first` are below it. Returns the
// first interval that is not below `high`.
std::size_t remove(std::vector<Interval>& from, std::size_t first, const Interval& hole) {
    std::size_t n = first;
    while (n < from.size() && from[n].high <= hole.low) ++n;
    while (n < from.size() && from[n].low < hole.high) {
        const Interval whole = from[n];
        const bool below = whole.low < hole.low;
        const bool above = whole.high > hole.high;
        if (below && above) {
            from[n].high = hole.low;
            from.insert(from.begin() + static_cast<std::ptrdiff_t>(n) + 1, {hole.high, whole.high});
            return n + 1;
        }
        if (below) {
            from[n++].high = hole.low;
        } else if (above) {
            from[n].low = hole.high;
            return n;
        } else {
            from.erase(from.begin() + static_cast<std::ptrdiff_t>(n));
        }
    }
    return n;
}

// Orders views so that successive ones are far apart: most places outside of the object are ruled out by the first few.
template <class T>
void spread_out(std::vector<T>& in_turning_order) {
    constexpr double kGolden = 0.6180339887498949;
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t n = 0; n < in_turning_order.size(); ++n) {
        const double turns = kGolden * static_cast<double>(n);
        order.emplace_back(turns - std::floor(turns), n);
    }
    std::sort(order.begin(), order.end());
    // Rank of each n: successive ranks are far apart in turning order.
    std::vector<T> spread(in_turning_order.size());
    for (std::size_t rank = 0; rank < order.size(); ++rank)
        spread[order[rank].second] = std::move(in_turning_order[rank]);
    in_turning_order = std::move(spread);
}

}  // namespace

VisualHull::VisualHull(const std::vector<const WorkView*>& views, int margin_px, int tolerated)
    : tolerated_(tolerated) {
    silhouettes_.resize(views.size());
    for_each_index(views.size(), [&](std::size_t n) {
        const WorkView& view = *views[n];
        if (!has_object(view)) return;
        Silhouette& silhouette = silhouettes_[n];
        silhouette.view = &view;
        std::vector<std::uint8_t> near_object;
        for (int column = 0; column < view.width; ++column) {
            widen_column(view, column, margin_px, near_object);
            forbid_slopes(view, near_object, margin_px, silhouette.forbidden);
            silhouette.ends.push_back(static_cast<std::uint32_t>(silhouette.forbidden.size()));
        }
    });
    std::erase_if(silhouettes_, [](const Silhouette& silhouette) { return silhouette.view == nullptr; });
    spread_out(silhouettes_);
}

void VisualHull::heights_above(const glm::dvec2& place, std::vector<Interval>& heights, const Interval& within) const {
    if (tolerated_ > 0) {
        tolerant_heights(place, heights);
        for (Interval& each : heights) each = {std::max(each.low, within.low), std::min(each.high, within.high)};
        std::erase_if(heights, [](const Interval& each) { return each.low >= each.high; });
        return;
    }
    heights.assign(1, within);
    for (const Silhouette& silhouette : silhouettes_) {
        const ProjectedColumn seen = silhouette.view->see(place);
        if (seen.axial <= 0 || seen.column < 0 || seen.column >= silhouette.view->width) continue;
        std::size_t first = 0;
        for (const Interval& slopes : silhouette.forbidden_slopes(static_cast<int>(seen.column))) {
            first = remove(heights, first, silhouette.forbidden_heights(slopes, seen.axial));
        }
        if (heights.empty()) return;
    }
}

// Sweeps over the ends of all silhouettes' forbidden runs; heights covered by at most `tolerated_` runs are allowed.
void VisualHull::tolerant_heights(const glm::dvec2& place, std::vector<Interval>& heights) const {
    struct Event {
        double height = 0;
        int change = 0;
    };
    std::vector<Event> events;
    for (const Silhouette& silhouette : silhouettes_) {
        const ProjectedColumn seen = silhouette.view->see(place);
        if (seen.axial <= 0 || seen.column < 0 || seen.column >= silhouette.view->width) continue;
        for (const Interval& slopes : silhouette.forbidden_slopes(static_cast<int>(seen.column))) {
            const Interval forbidden = silhouette.forbidden_heights(slopes, seen.axial);
            events.push_back({forbidden.low, 1});
            events.push_back({forbidden.high, -1});
        }
    }
    std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.height < b.height; });
    heights.clear();
    double begin = kAnyHeight.low;
    int forbid = 0;
    for (const Event& event : events) {
        const bool was_allowed = forbid <= tolerated_;
        forbid += event.change;
        const bool is_allowed = forbid <= tolerated_;
        if (was_allowed && !is_allowed && event.height > begin) heights.push_back({begin, event.height});
        if (!was_allowed && is_allowed) begin = event.height;
    }
    heights.push_back({begin, kAnyHeight.high});
}

SampledHull::SampledHull(VisualHull hull, double spacing)
    : hull_(std::move(hull)), spacing_(spacing), points_per_unit_(1 / spacing) {
    side_ = 2 * static_cast<int>(std::ceil(kReach * points_per_unit_)) + 1;
    across_ = (side_ + kTileSide - 1) / kTileSide;
    tiles_ = std::vector<Tile>(static_cast<std::size_t>(across_) * static_cast<std::size_t>(across_));
}

void SampledHull::sample(int t) const {
    Tile& tile = tiles_[static_cast<std::size_t>(t)];
    std::call_once(tile.once, [&] {
        const int middle = side_ / 2;
        tile.ends.reserve(static_cast<std::size_t>(kTileSide * kTileSide));
        std::vector<Interval> heights;
        for (int n = 0; n < kTileSide * kTileSide; ++n) {
            const int x = t % across_ * kTileSide + n % kTileSide;
            const int y = t / across_ * kTileSide + n / kTileSide;
            const glm::dvec2 place = glm::dvec2(x - middle, y - middle) * spacing_;
            heights.clear();
            if (glm::length(place) <= kReach + spacing_) hull_.heights_above(place, heights);
            tile.intervals.insert(tile.intervals.end(), heights.begin(), heights.end());
            tile.ends.push_back(static_cast<std::uint32_t>(tile.intervals.size()));
        }
        tile.sampled.store(true, std::memory_order_release);
    });
}

double inconsistent_share(const std::vector<const WorkView*>& views, const VisualHull& hull, const DepthRange& range) {
    constexpr int kEveryColumn = 8;
    std::vector<std::int64_t> pixels(views.size(), 0);
    std::vector<std::int64_t> contradicted(views.size(), 0);
    for_each_index(views.size(), [&](std::size_t v) {
        const WorkView& view = *views[v];
        std::vector<Interval> heights;
        std::vector<int> unseen;  // object rows of the column whose rays have not met the hull yet
        for (int column = static_cast<int>(v) % kEveryColumn; column < view.width; column += kEveryColumn) {
            unseen.clear();
            for (int row = 0; row < view.height; ++row) {
                if (view.at(column, row).a >= kInside) unseen.push_back(row);
            }
            pixels[v] += static_cast<std::int64_t>(unseen.size());
            const HorizontalRay ray = view.ray_of(column + 0.5);
            // From the middle outwards: most rays meet the hull there, and the remaining levels are not needed.
            for (int n = 0; n < range.count && !unseen.empty(); ++n) {
                const int level = range.count / 2 + (n % 2 == 0 ? n / 2 : -(n + 1) / 2);
                const double depth = range.at(level);
                const double axial = ray.axial_at(depth);
                if (axial <= 0) continue;
                // Only heights of the unseen rows are needed, with a margin of one row.
                const Interval within = {view.height_of(unseen.back() + 2, axial),
                                         view.height_of(unseen.front() - 1, axial)};
                hull.heights_above(ray.place_at(depth), heights, within);
                for (const Interval& interval : heights) {
                    const auto row_of = [&](double height) {
                        return static_cast<int>(std::clamp(view.row_of(height, axial), 0.0, double(view.height)));
                    };
                    const int top = row_of(interval.high);
                    const int bottom = row_of(interval.low);
                    std::erase_if(unseen, [&](int row) { return row >= top && row < bottom; });
                }
            }
            contradicted[v] += static_cast<std::int64_t>(unseen.size());
        }
    });
    const auto all = std::accumulate(pixels.begin(), pixels.end(), std::int64_t{0});
    const auto bad = std::accumulate(contradicted.begin(), contradicted.end(), std::int64_t{0});
    return all == 0 ? 0 : static_cast<double>(bad) / static_cast<double>(all);
}

}  // namespace rs::encode
