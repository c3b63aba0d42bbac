#pragma once
// Renders a textured ellipsoid with three different axes that turns in front of a plain background (orthographic).

#include "rayspace/base/conventions.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace rs::test {

struct TurningEllipsoid {
    int width = 160;
    int height = 120;
    glm::dvec3 radii{50, 34, 28};  // px; y is the axis
    double elevation_rad = radians(20);
    double exposure = 1;  // factor on the codes
    double blur_rad = 0;  // rotation during the exposure of a frame
};

// Value noise in 0..1 with cells of one unit.
inline double value_noise(const glm::dvec3& p) {
    const auto lattice = [](int x, int y, int z) {
        std::uint32_t h = static_cast<std::uint32_t>(x) * 374761393U + static_cast<std::uint32_t>(y) * 668265263U +
                          static_cast<std::uint32_t>(z) * 2147483647U;
        h = (h ^ (h >> 13U)) * 1274126177U;
        return static_cast<double>((h ^ (h >> 16U)) & 0xFFFFU) / 65535.0;
    };
    const glm::dvec3 cell = glm::floor(p);
    const glm::dvec3 f = p - cell;
    const glm::dvec3 w = f * f * (3.0 - 2.0 * f);
    double sum = 0;
    for (int i = 0; i < 8; ++i) {
        const int dx = i & 1, dy = (i >> 1) & 1, dz = i >> 2;
        sum += lattice(static_cast<int>(cell.x) + dx, static_cast<int>(cell.y) + dy, static_cast<int>(cell.z) + dz) *
               (dx != 0 ? w.x : 1 - w.x) * (dy != 0 ? w.y : 1 - w.y) * (dz != 0 ? w.z : 1 - w.z);
    }
    return sum;
}

inline Image<Rgba8> sharp_frame(const TurningEllipsoid& video, double angle_rad) {
    const auto code = [&](double value) {
        return static_cast<std::uint8_t>(std::clamp(video.exposure * value, 0.0, 255.0));
    };
    Image<Rgba8> frame(video.width, video.height, {code(150), code(152), code(155), 255});
    const double s = std::sin(video.elevation_rad), c = std::cos(video.elevation_rad);
    const double sin_a = std::sin(angle_rad), cos_a = std::cos(angle_rad);
    const auto to_object = [&](const glm::dvec3& p) {
        return glm::dvec3(cos_a * p.x - sin_a * p.z, p.y, sin_a * p.x + cos_a * p.z);
    };
    const glm::dvec3 ray = to_object({0, -s, -c}) / video.radii;  // away from the camera
    for (int y = 0; y < video.height; ++y) {
        for (int x = 0; x < video.width; ++x) {
            const double u = x + 0.5 - 0.5 * video.width, v = 0.5 * video.height - y - 0.5;
            const glm::dvec3 from = to_object({u, v * c, -v * s}) / video.radii;
            const double a = glm::dot(ray, ray), b = glm::dot(from, ray), d = b * b - a * (glm::dot(from, from) - 1);
            if (d < 0) continue;
            const glm::dvec3 hit = video.radii * (from - (b + std::sqrt(d)) / a * ray);
            const double tone = 0.7 * value_noise(hit / 5.0 + 100.0) + 0.3 * value_noise(hit / 2.5 + 50.0);
            frame(x, y) = {code(20 + 200 * tone), code(30 + 170 * tone), code(60 + 120 * tone), 255};
        }
    }
    return frame;
}

// Averages eight sharp frames if motion blur is enabled.
inline Image<Rgba8> film_frame(const TurningEllipsoid& video, double angle_rad) {
    if (video.blur_rad == 0) return sharp_frame(video, angle_rad);
    constexpr int kParts = 8;
    std::vector<glm::ivec3> sums(static_cast<std::size_t>(video.width) * static_cast<std::size_t>(video.height));
    for (int part = 0; part < kParts; ++part) {
        const Image<Rgba8> sharp = sharp_frame(video, angle_rad + video.blur_rad * ((part + 0.5) / kParts - 0.5));
        for (std::size_t i = 0; i < sums.size(); ++i) {
            sums[i] += glm::ivec3(sharp.pixels()[i].r, sharp.pixels()[i].g, sharp.pixels()[i].b);
        }
    }
    Image<Rgba8> frame(video.width, video.height);
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const glm::ivec3 mean = sums[i] / kParts;
        frame.pixels()[i] = {static_cast<std::uint8_t>(mean.x), static_cast<std::uint8_t>(mean.y),
                             static_cast<std::uint8_t>(mean.z), 255};
    }
    return frame;
}

}  // namespace rs::test
