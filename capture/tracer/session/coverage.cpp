#include "capture/tracer/session/coverage.hpp"

#include "capture/tracer/integrator/sampler.hpp"
#include "rayspace/base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rs::capture {
namespace {

glm::dvec2 middle_of(int width, int height) {
    return glm::dvec2(width, height) / 2.0;
}

}  // namespace

ImagePlacement recentring_placement(const Image<float>& coverage) {
    glm::dvec2 low(coverage.width(), coverage.height());
    glm::dvec2 high(0.0);
    for (int y = 0; y < coverage.height(); ++y) {
        for (int x = 0; x < coverage.width(); ++x) {
            if (!(coverage(x, y) > 0)) continue;
            low = glm::min(low, glm::dvec2(x, y));
            high = glm::max(high, glm::dvec2(x + 1, y + 1));
        }
    }
    if (!(high.x > low.x)) return {};
    ImagePlacement place;
    place.scale = kRecentredFill * std::min(coverage.width() / (high.x - low.x), coverage.height() / (high.y - low.y));
    place.shift_px = place.scale * (middle_of(coverage.width(), coverage.height()) - (low + high) / 2.0);
    return place;
}

RayImage apply_placement(RayImage rays, const ImagePlacement& place) {
    const glm::dvec2 middle = middle_of(rays.width, rays.height);
    rays.ray = [whole = std::move(rays.ray), place, middle](double x, double y) {
        const glm::dvec2 p = place.undone({x, y}, middle);
        return whole(p.x, p.y);
    };
    return rays;
}

Image<RgbaF> apply_placement(const Image<RgbaF>& image, const ImagePlacement& place) {
    const int width = image.width();
    const int height = image.height();
    const glm::dvec2 middle = middle_of(width, height);
    Image<RgbaF> result(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::dvec2 p = place.undone({x + 0.5, y + 0.5}, middle) - 0.5;
            const double left = std::clamp(p.x, 0.0, width - 1.0);
            const double top = std::clamp(p.y, 0.0, height - 1.0);
            const int x0 = std::min(static_cast<int>(left), std::max(0, width - 2));
            const int y0 = std::min(static_cast<int>(top), std::max(0, height - 2));
            const int x1 = std::min(x0 + 1, width - 1);
            const int y1 = std::min(y0 + 1, height - 1);
            const auto u = static_cast<float>(left - x0);
            const auto v = static_cast<float>(top - y0);
            const auto mixed = [&](float RgbaF::*channel) {
                const float above = image(x0, y0).*channel * (1 - u) + image(x1, y0).*channel * u;
                const float below = image(x0, y1).*channel * (1 - u) + image(x1, y1).*channel * u;
                return above * (1 - v) + below * v;
            };
            result(x, y) = {mixed(&RgbaF::r), mixed(&RgbaF::g), mixed(&RgbaF::b), mixed(&RgbaF::a)};
        }
    }
    return result;
}

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
