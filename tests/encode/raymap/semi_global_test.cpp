// Compares semi-global matching with the paper's recursion, implemented per pixel and path.

#include "encode/raymap/semi_global.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace rs::encode {
namespace {

struct Pixels {
    WorkView view;
    CostVolume volume;
};

// An object with holes, colour edges, and random costs of random levels of each pixel: all, one or some.
Pixels random_pixels(int width, int height, int levels, std::mt19937_64& random) {
    Pixels made;
    made.view.width = width;
    made.view.height = height;
    made.view.columns = Image<Rgba8>(height, width);
    made.volume.box = {1, 1, width, height - 1};
    made.volume.levels = levels;
    for (int x = 0; x < width; ++x) {
        for (int y = 0; y < height; ++y) {
            const auto code = [&] { return static_cast<std::uint8_t>(random() % 3 * 40); };
            const bool object = random() % 6 != 0;
            made.view.columns(y, x) = {code(), code(), code(), object ? std::uint8_t{255} : std::uint8_t{0}};
            if (x < 1 || y < 1 || y >= height - 1) continue;
            PixelLevels& pixel = made.volume.pixels.emplace_back();
            if (!object) continue;
            const bool all = random() % 3 == 0;
            const int first = all ? 0 : static_cast<int>(random() % static_cast<unsigned>(levels));
            const int count = all ? levels : 1 + static_cast<int>(random() % static_cast<unsigned>(levels - first));
            pixel = {static_cast<std::uint32_t>(made.volume.costs.size()), static_cast<std::uint16_t>(first),
                     static_cast<std::uint16_t>(count)};
            for (int n = 0; n < count; ++n) {
                made.volume.costs.push_back(static_cast<std::uint8_t>(random() % kMaxCost));
            }
        }
    }
    return made;
}

constexpr int kNever = 1'000'000;  // cost of levels that the pixel does not have

// L(p, n) = C(p, n) + min(L(q, n), L(q, n +- 1) + P1, min L(q) + P2) - min L(q), where q is the pixel before p on the
// path; the path begins where q is outside of the object. (Hirschmüller 2008, equation 13.)
class Path {
public:
    Path(const Pixels& pixels, const SmoothnessOptions& options, int dx, int dy)
        : pixels_(pixels), options_(options), dx_(dx), dy_(dy) {}

    const std::vector<int>& at(int x, int y) {
        const auto known = costs_.find({x, y});
        if (known != costs_.end()) return known->second;
        const auto& [view, volume] = pixels_;
        const PixelLevels& pixel = volume.of(x, y);
        std::vector<int> costs(static_cast<std::size_t>(volume.levels), kNever);
        for (std::uint32_t n = 0; n < pixel.count; ++n) costs[pixel.first + n] = volume.costs[pixel.begin + n];
        const int u = x - dx_;
        const int v = y - dy_;
        const ObjectBox& box = volume.box;
        if (u >= box.left && u < box.right && v >= box.top && v < box.bottom && view.at(u, v).a > 0) {
            const std::vector<int> before = at(u, v);
            const int least = *std::min_element(before.begin(), before.end());
            const Rgba8 p = view.at(x, y), q = view.at(u, v);
            const int edge = std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b);
            const int large = std::max(options_.small_step + 2, options_.large_step * 24 / (24 + edge));
            for (int n = 0; n < volume.levels; ++n) {
                int best = least + large;
                for (int m = 0; m < volume.levels; ++m) {
                    if (std::abs(m - n) > 1) continue;
                    best = std::min(best, before[static_cast<std::size_t>(m)] + (m == n ? 0 : options_.small_step));
                }
                if (costs[static_cast<std::size_t>(n)] != kNever) costs[static_cast<std::size_t>(n)] += best - least;
            }
        }
        return costs_.emplace(std::pair(x, y), std::move(costs)).first->second;
    }

private:
    const Pixels& pixels_;
    SmoothnessOptions options_;
    int dx_;
    int dy_;
    std::map<std::pair<int, int>, std::vector<int>> costs_;
};

TEST(SemiGlobal, IsTheSumOfEightPaths) {
    constexpr std::uint64_t kSeed = 8;
    SCOPED_TRACE(kSeed);
    std::mt19937_64 random(kSeed);
    for (const auto& [width, height, levels] :
         std::vector<std::array<int, 3>>{{7, 9, 5}, {12, 6, 17}, {3, 4, 2}, {40, 30, 9}, {9, 8, 50}}) {
        const Pixels pixels = random_pixels(width, height, levels, random);
        for (const SmoothnessOptions options : {SmoothnessOptions{}, SmoothnessOptions{7, 30}}) {
            const Image<float> found = semi_global_levels(pixels.view, pixels.volume, options);
            std::vector<Path> paths;
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                    if (dx != 0 || dy != 0) paths.emplace_back(pixels, options, dx, dy);
                }
            }
            const ObjectBox& box = pixels.volume.box;
            for (int y = 0; y < height; ++y) {
                for (int x = 0; x < width; ++x) {
                    const bool inside = x >= box.left && x < box.right && y >= box.top && y < box.bottom;
                    if (!inside || pixels.view.at(x, y).a == 0) {
                        EXPECT_TRUE(std::isnan(found(y, x)));
                        continue;
                    }
                    std::vector<int> sum(static_cast<std::size_t>(levels));
                    for (Path& path : paths) {
                        const std::vector<int>& costs = path.at(x, y);
                        for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += costs[n];
                    }
                    const auto best = static_cast<std::size_t>(std::min_element(sum.begin(), sum.end()) - sum.begin());
                    double level = static_cast<double>(best);
                    if (best > 0 && best + 1 < sum.size() && sum[best - 1] < kNever && sum[best + 1] < kNever) {
                        const double before = sum[best - 1] - sum[best];
                        const double after = sum[best + 1] - sum[best];
                        if (before + after > 0) level += (before - after) / (2 * (before + after));
                    }
                    EXPECT_NEAR(static_cast<double>(found(y, x)), level, 1e-5) << x << ", " << y;
                }
            }
        }
    }
}

}  // namespace
}  // namespace rs::encode
