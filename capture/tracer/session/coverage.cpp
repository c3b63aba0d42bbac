#include "capture/tracer/session/coverage.hpp"

#include "capture/tracer/integrator/sampler.hpp"
#include "rayspace/base/parallel.hpp"

#include <algorithm>
#include <limits>

namespace rs::capture {

namespace {

constexpr int kFirstRays = 16;
constexpr int kOutlineRays = 256;

float covered_share(const RayScene& scene, const RayImage& rays, int x, int y, int count) {
    const glm::vec3 centre(rays.centre);
    const std::uint64_t key = mix_bits(static_cast<std::uint64_t>(y) << 32 | static_cast<std::uint64_t>(x));
    int hits = 0;
    for (int i = 0; i < count; ++i) {
        const glm::dvec2 offset(Sampler(key, static_cast<std::uint32_t>(i)).next_2d());
        const glm::vec3 direction(glm::normalize(rays.ray(x + offset.x, y + offset.y)));
        hits += scene.occluded(centre, direction, std::numeric_limits<float>::infinity(), 0.0F) ? 1 : 0;
    }
    return static_cast<float>(hits) / static_cast<float>(count);
}

bool is_on_contour(const Image<float>& shares, int x, int y) {
    const float own = shares(x, y);
    if (own > 0 && own < 1) return true;
    for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, shares.height() - 1); ++ny) {
        for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, shares.width() - 1); ++nx) {
            if (shares(nx, ny) != own) return true;
        }
    }
    return false;
}

}  // namespace

Image<float> trace_coverage(const RayScene& scene, const RayImage& rays, int threads) {
    Image<float> first(rays.width, rays.height);
    if (scene.empty()) return first;
    for_each_index(rays.height, threads, [&](std::int64_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < rays.width; ++x) first(x, y) = covered_share(scene, rays, x, y, kFirstRays);
    });
    Image<float> shares = first;
    for_each_index(rays.height, threads, [&](std::int64_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < rays.width; ++x) {
            if (is_on_contour(first, x, y)) shares(x, y) = covered_share(scene, rays, x, y, kOutlineRays);
        }
    });
    return shares;
}

}  // namespace rs::capture
