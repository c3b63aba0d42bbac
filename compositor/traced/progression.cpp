#include "compositor/traced/progression.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace rs::compositor {
namespace {

constexpr int kMaxPasses = 65536;
constexpr double kMinCost_s = 1e-12;  // per cell, since clocks are coarse

std::size_t level_of(int side) {
    return static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(side)));
}

}  // namespace

double FirstGridSelector::cells(int width, int height, int side) {
    const int across = (width + side - 1) / side, down = (height + side - 1) / side;
    return static_cast<double>(across) * down;
}

int FirstGridSelector::coarsest_side(int width, int height, int cells) {
    int side = 1;
    while (side < 1 << (kSides - 1) && 2 * side * cells <= std::max(width, height)) side *= 2;
    return side;
}

int FirstGridSelector::side(TracedMethod method, int width, int height) const {
    if (cells_) return coarsest_side(width, height, *cells_);
    const int coarsest = coarsest_side(width, height);
    const auto known = costs_.find(method);
    if (known == costs_.end()) return coarsest;
    int chosen = coarsest;
    double of_cell = 0;
    for (std::size_t level = kSides; level-- > 0;) {
        const int side = 1 << level;
        // Costs per cell that were not measured are at most those of coarser grids.
        if (known->second[level] > 0) of_cell = known->second[level];
        if (side > coarsest || of_cell <= 0) continue;
        if (of_cell * cells(width, height, side) <= time_limit_s_) chosen = side;
    }
    return chosen;
}

void FirstGridSelector::record_time(TracedMethod method, int width, int height, int side, double seconds) {
    Costs& costs = costs_[method];
    const double before = costs[level_of(side)];
    const double now = std::max(seconds / cells(width, height, side), kMinCost_s);
    if (before > 0) {
        for (double& cost : costs) cost *= now / before;
    }
    costs[level_of(side)] = now;
}

void refine(TracedRenderer& renderer, const Camera& camera, FirstGridSelector& grid, const Clock& clock,
            const std::atomic<bool>& stop, const std::function<void(Image<Rgba8> image, int passes)>& publish) {
    const TracedMethod method = renderer.method();
    double begin = 0;
    const auto record = [&](int side) { grid.record_time(method, camera.width, camera.height, side, clock() - begin); };
    for (int side = grid.side(method, camera.width, camera.height); side > 1; side /= 2) {
        begin = clock();
        std::optional<Image<Rgba8>> coarse = renderer.coarse_image(camera, side, &stop);
        if (!coarse) return;
        record(side);
        publish(std::move(*coarse), 0);
        if (stop) return;
    }
    renderer.begin_image(camera);
    while (renderer.passes() < kMaxPasses) {
        begin = clock();
        if (!renderer.add_pass(nullptr, &stop)) return;
        Image<Rgba8> image = renderer.image();
        record(1);
        publish(std::move(image), renderer.passes());
    }
}

}  // namespace rs::compositor
