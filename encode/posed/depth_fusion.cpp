#include "encode/posed/depth_fusion.hpp"

#include "rayspace/base/parallel_loop.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace rs::encode {
namespace {

constexpr float kTruncation = SignedVolume::kTruncation_voxels;
// Farther behind a map's surface a point is hidden in its photo.
constexpr float kHidden_voxels = 8;
// Quantile of the distances. Depths are limited by the hull in front, so that their errors are mostly behind.
constexpr double kQuantile = 0.35;

// Signed distance of a point from a depth map's surface along the pixel's ray, voxels; nullopt where it is hidden by
// the surface, or the map has no depth. Of the four pixels around its projection the one nearest to it decides, since
// edges of depth maps are inaccurate by a pixel.
std::optional<float> distance_in_map(const PhotoDepth& map, const glm::dvec3& p, double voxel) {
    const glm::dvec3 seen = map.camera.project(p);
    if (!(seen.z > 0 && seen.x >= 0.5 && seen.y >= 0.5 && seen.x < map.depth.width() - 0.5 &&
          seen.y < map.depth.height() - 0.5)) {
        return std::nullopt;
    }
    const auto x = static_cast<int>(seen.x - 0.5);
    const auto y = static_cast<int>(seen.y - 0.5);
    const auto z = static_cast<float>(seen.z);
    std::optional<float> nearest;
    for (const auto& [i, j] : {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)}) {
        const float depth = map.depth(x + i, y + j);
        if (depth <= 0) continue;
        if (!nearest || std::abs(depth - z) < std::abs(*nearest)) nearest = depth - z;
    }
    if (nearest) *nearest /= static_cast<float>(voxel);
    if (!nearest || *nearest < -kHidden_voxels) return std::nullopt;
    return std::clamp(*nearest, -kTruncation, kTruncation);
}

// Quantile of the depth maps' distances; -kTruncation where no map has one: what no photo shows is solid. The mean
// would lose thin parts, behind which a few maps have the background.
float fused_distance(std::span<const PhotoDepth> depths, const glm::dvec3& p, double voxel, std::vector<float>& found) {
    found.clear();
    for (const PhotoDepth& map : depths) {
        if (const auto distance = distance_in_map(map, p, voxel)) found.push_back(*distance);
    }
    if (found.empty()) return -kTruncation;
    const auto at = found.begin() + static_cast<std::ptrdiff_t>(kQuantile * static_cast<double>(found.size()));
    std::nth_element(found.begin(), at, found.end());
    return *at;
}

}  // namespace

SignedVolume fuse_depths(const SignedVolume& hull, std::span<const PhotoDepth> depths, Progress* progress) {
    const VolumeGrid& grid = hull.grid();
    SignedVolume fused = hull;
    if (progress != nullptr) progress->start("fusing depth", grid.size.z);
    for_each_index(grid.size.z, [&](int z) {
        std::vector<float> found;
        for (int y = 0; y < grid.size.y; ++y) {
            float* const row = fused.row(y, z);
            for (int x = 0; x < grid.size.x; ++x) {
                // Silhouettes take precedence over depth.
                if (row[x] < 1)
                    row[x] = std::max(row[x], fused_distance(depths, grid.centre(x, y, z), grid.voxel, found));
            }
        }
        if (progress != nullptr) progress->advance();
    });
    if (progress != nullptr) progress->finish();
    fused.index_empty_blocks();
    return fused;
}

}  // namespace rs::encode
