#pragma once
// The visual hull: what all silhouettes of a ring, and of its neighbours, allow. It bounds the search for depth.
//
// Cameras are upright, so all points above a place of the ground plan fall into one column of a picture, at rows linear
// in height. A column of a silhouette is a few runs of rows; so the hull above a place is an intersection of runs,
// exact and without a grid of voxels.

#include "encode/raymap/silhouettes/work_view.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

namespace rs::encode {

// Heights (or rows) from `low` up to `high`.
struct Interval {
    double low = 0;
    double high = 0;
};

inline constexpr Interval kAnyHeight = {-1e6, 1e6};

class VisualHull {
public:
    // Silhouettes are widened by `margin_px` pixels of the working pictures on every side, for what calibration and
    // soft edges leave unsure. What lies outside of a picture's frame may be object. Views without any object pixel say
    // nothing and are left out. `views` must outlive the hull.
    // A place is ruled out where more than `tolerated` silhouettes forbid it: cut-outs that lack a part in some
    // pictures, or cameras that stand elsewhere than the rig states, else leave nothing.
    VisualHull(const std::vector<const WorkView*>& views, int margin_px, int tolerated = 0);

    // The heights above a place that the silhouettes allow, ascending and disjoint; of `within` only.
    void heights_above(const glm::dvec2& place, std::vector<Interval>& heights,
                       const Interval& within = kAnyHeight) const;

private:
    struct Silhouette {
        const WorkView* view = nullptr;
        // Heights above the camera's centre per axial depth, ascending within a column, column after column; and where
        // each column's end. Many places are computed: they lie close together in memory.
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

// A hull above the points of a square grid, for the many places that are needed: a tenth of the time of computing every
// silhouette for each. Thread-safe.
class SampledHull {
public:
    // Of all places up to kDeepest along every ray that passes the axis within kDeepest, `spacing` radii apart.
    SampledHull(VisualHull hull, double spacing);

    // VisualHull::heights_above the point of the grid that is next to `place`.
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

    // A square of points: what is read along a ray, and along the next one, lies close together in memory. Many
    // are never needed: each is sampled when it is.
    struct Tile {
        std::atomic<bool> sampled = false;
        std::once_flag once;
        std::vector<Interval> intervals;
        std::vector<std::uint32_t> ends;  // of each point's intervals, along x first
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

// The share of object pixels (0..1, sampled) whose rays the hull rules out entirely: what the silhouettes contradict
// one another by. `range` covers the object.
double contradicted_share(const std::vector<const WorkView*>& views, const VisualHull& hull, const DepthRange& range);

}  // namespace rs::encode
