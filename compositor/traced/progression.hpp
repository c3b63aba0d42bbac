#pragma once
// Progressive refinement of a traced view: a coarse grid within a time limit, then grids of halved cell size, then one
// sample per pixel at a time into a mean (L. Bergman, H. Fuchs, E. Grant, S. Spach, "Image Rendering by Adaptive
// Refinement", SIGGRAPH 1986).
//
//     first grid (32x32 cells and up) -> twice as fine -> ... -> pass 1 -> pass 2 -> ...
//
// Measured times only select the first grid, unless the user sets its size. The results do not depend on them: pass k
// is the mean of samples 1..k (filtered for radiosity).

#include "compositor/traced/traced_renderer.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

#include <array>
#include <atomic>
#include <functional>
#include <map>
#include <optional>

namespace rs::compositor {

/// Monotonic time in seconds.
using Clock = std::function<double()>;

/// Selects the first grid from measured render times.
class FirstGridSelector {
public:
    /// Time limit of an image while the visitor moves; with the rest of the frame it fits into 0.1 s.
    static constexpr double kTimeLimit_s = 0.07;
    static constexpr int kMinCells = 32;  // along the longer side, if the image has as many pixels

    /// \param cells along the longer side of every first grid, at least, >= 1; empty: selected by the time limit
    explicit FirstGridSelector(double time_limit_s = kTimeLimit_s, std::optional<int> cells = {})
        : time_limit_s_(time_limit_s), cells_(cells) {}

    /// Cell size in pixels, a power of two: the finest grid that is expected within the limit; the coarsest if none is
    /// or without measurements. With a number of cells: the largest that gives as many. 1: starts with pass 1.
    [[nodiscard]] int side(TracedMethod method, int width, int height) const;
    [[nodiscard]] static int coarsest_side(int width, int height, int cells = kMinCells);
    /// Records the render time of an image. Costs of all cell sizes scale with the ratio to the last time at this size.
    void record_time(TracedMethod method, int width, int height, int side, double seconds);

private:
    static constexpr std::size_t kSides = 12;
    using Costs = std::array<double, kSides>;  // seconds per cell, [log2 of the cell size]; 0 if not measured
    [[nodiscard]] static double cells(int width, int height, int side);

    double time_limit_s_;
    std::optional<int> cells_;
    std::map<TracedMethod, Costs> costs_;
};

/// Publishes successive images until `stop` becomes true. `passes` is 0 for grids.
void refine(TracedRenderer& renderer, const Camera& camera, FirstGridSelector& grid, const Clock& clock,
            const std::atomic<bool>& stop, const std::function<void(Image<Rgba8> image, int passes)>& publish);

}  // namespace rs::compositor
