#pragma once
// The visual hull: the intersection of the silhouettes of a ring and of its adjacent rings. It bounds depth estimation.
//
// Cameras are upright, so that all points above a place of the ground plan project into one column of a photo, at rows
// linear in height. A column of a silhouette consists of a few runs of rows; the hull above a place is an intersection
// of such runs, exact and without voxels.

#include "encode/raymap/silhouettes/work_view.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

namespace rs::encode {

/// Heights (or rows) from `low` up to `high`.
struct Interval {
    double low = 0;
    double high = 0;
};

inline constexpr Interval kAnyHeight = {-1e6, 1e6};

class VisualHull {
public:
    /// Silhouettes are dilated by `margin_px` pixels of the working views, for errors of calibration and soft edges.
    /// Points outside of a photo's frame may be part of the object. Views without object pixels are ignored. `views`
    /// must outlive the hull. A point is ruled out where more than `tolerated` silhouettes forbid it, for masks that
    /// lack parts and inaccurate rigs.
    VisualHull(const std::vector<const WorkView*>& views, int margin_px, int tolerated = 0);

    /// Replaces `heights` by the heights above a place that the silhouettes allow within `within`, ascending and
    /// disjoint.
    void heights_above(const glm::dvec2& place, std::vector<Interval>& heights,
                       const Interval& within = kAnyHeight) const;

private:
    struct Silhouette {
        const WorkView* view = nullptr;
        // Forbidden heights above the camera's centre per unit of axial depth, ascending within a column, column after
        // column in one array; and the end of each column.
        std::vector<Interval> forbidden;
        std::vector<std::uint32_t> ends;
        [[nodiscard]] std::span<const Interval> forbidden_slopes(int column) const {
            const auto n = static_cast<std::size_t>(column);
            const std::uint32_t begin = n == 0 ? 0 : ends[n - 1];
            return std::span(forbidden).subspan(begin, ends[n] - begin);
        }
        [[nodiscard]] Interval forbidden_heights(const Interval& slopes, double axial) const {
            return {view->centre_y + axial * slopes.low, view->centre_y + axial * slopes.high};
        }
    };
    void tolerant_heights(const glm::dvec2& place, std::vector<Interval>& heights) const;  // of all

    std::vector<Silhouette> silhouettes_;
    int tolerated_ = 0;
};

/// A visual hull cached above the points of a square grid; a tenth of the time of evaluating every silhouette for each
/// place. Thread-safe.
class SampledHull {
public:
    /// Covers all places up to kMaxDepth along every ray that passes the axis within kMaxDepth. `spacing` in object
    /// radii.
    SampledHull(VisualHull hull, double spacing);

    /// VisualHull::heights_above the grid point nearest to `place`.
    [[nodiscard]] std::span<const Interval> heights_above(const glm::dvec2& place) const {
        const int x = point(place.x);
        const int y = point(place.y);
        const int t = y / kTileSide * across_ + x / kTileSide;
        const Tile& tile = tiles_[static_cast<std::size_t>(t)];
        if (!tile.sampled.load(std::memory_order_acquire)) sample(t);
        const auto n = static_cast<std::size_t>(y % kTileSide * kTileSide + x % kTileSide);
        const std::uint32_t begin = n == 0 ? 0 : tile.ends[n - 1];
        return std::span(tile.intervals).subspan(begin, tile.ends[n] - begin);
    }

private:
    static constexpr int kTileSide = 32;  // points

    // A square of grid points, for memory locality along neighboring rays. Computed on first use.
    struct Tile {
        std::atomic<bool> sampled = false;
        std::once_flag once;
        std::vector<Interval> intervals;
        std::vector<std::uint32_t> ends;  // end of each point's intervals, row by row
    };
    [[nodiscard]] int point(double along) const {
        return std::clamp(static_cast<int>(std::lround(along * points_per_unit_)) + side_ / 2, 0, side_ - 1);
    }
    void sample(int t) const;

    VisualHull hull_;
    double spacing_;
    double points_per_unit_;
    int side_ = 1;    // points
    int across_ = 1;  // tiles
    mutable std::vector<Tile> tiles_;
};

/// The share of object pixels (0..1, sampled) whose rays miss the hull: a measure of the silhouettes' inconsistency.
/// `range` covers the object.
double inconsistent_share(const std::vector<const WorkView*>& views, const VisualHull& hull, const DepthRange& range);

}  // namespace rs::encode
