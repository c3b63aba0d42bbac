#pragma once
// The images of a view that is refined: a grid that is there in time, then grids each twice as fine as the one
// before, then a sample of each pixel at a time into a mean (L. Bergman, H. Fuchs, E. Grant, S. Spach, "Image Rendering
// by Adaptive Refinement", SIGGRAPH 1986).
//
//     first grid (32x32 cells and up) -> twice as fine -> ... -> pass 1 -> pass 2 -> ...
//
// Only where this begins hangs on the time that images take. What they show does not: pass k is the mean of the
// samples 1..k (of radiosity: filtered), whatever was shown before it.

#include "compositor/traced/traced_renderer.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

#include <array>
#include <atomic>
#include <functional>
#include <map>

namespace rs::compositor {

// Seconds since any moment.
using Clock = std::function<double()>;

// Chooses the first grid by what images took so far.
class FirstGrid {
public:
    // What a visitor who moves waits for an image; what comes besides (taking it into the frame) fits into a tenth of
    // a second with it.
    static constexpr double kInTime_s = 0.07;
    static constexpr int kLeastCells = 32;  // along the longer side of an image, if it has as many pixels

    explicit FirstGrid(double in_time_s = kInTime_s) : in_time_s_(in_time_s) {}

    // Pixels along a cell, a power of two: the finest grid that is expected in time; the coarsest where none is, or
    // nothing is known yet. 1: images are quick enough to begin with pass 1.
    [[nodiscard]] int side(TracedMethod method, int width, int height) const;
    [[nodiscard]] static int coarsest_side(int width, int height);
    // An image of this size, of cells of this side, took so long. Where it took longer than the last of its kind, so
    // will the others.
    void took(TracedMethod method, int width, int height, int side, double seconds);

private:
    static constexpr std::size_t kSides = 12;
    using Costs = std::array<double, kSides>;  // of a cell in s, [log2 of its side]; 0 where none was measured
    [[nodiscard]] static double cells(int width, int height, int side);

    double in_time_s_;
    std::map<TracedMethod, Costs> costs_;
};

// Publishes one image after the other until `stop` becomes true. `passes` is 0 for grids.
void refine(TracedRenderer& renderer, const Camera& camera, FirstGrid& grid, const Clock& clock,
            const std::atomic<bool>& stop, const std::function<void(Image<Rgba8> image, int passes)>& publish);

}  // namespace rs::compositor
