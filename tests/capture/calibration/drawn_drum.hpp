#pragma once
// Rendered images of a spotted drum on a turntable, with ground truth: a short upright cylinder of solid noise with a
// flat top, so that its surface has features all around and its silhouette does not depend on the angle.

#include "capture/calibration/model/turntable_model.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/parallel_loop.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace rs::test {

struct Drum {
    double radius = 0.13;
    double height = 0.2;
    double middle = -0.364;  // height of the point at the centre of turn_model()'s image
    double grain = 0.028;    // length scale of the noise
    bool is_spotted = true;
};

namespace drum {

// Smooth noise of about -1..1 in space.
inline double noise(const glm::dvec3& p) {
    const auto lattice = [](int x, int y, int z) {
        std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343U ^ static_cast<std::uint32_t>(y) * 0xd8163841U ^
                          static_cast<std::uint32_t>(z) * 0xcb1ab31fU;
        h = (h ^ (h >> 15)) * 0x2c1b3c6dU;
        h = (h ^ (h >> 12)) * 0x297a2d39U;
        return static_cast<double>((h ^ (h >> 15)) & 0xffffU) / 32767.5 - 1;
    };
    const glm::dvec3 base = glm::floor(p);
    const glm::dvec3 t = p - base;
    const glm::dvec3 s = t * t * (3.0 - 2.0 * t);
    const auto x = static_cast<int>(base.x), y = static_cast<int>(base.y), z = static_cast<int>(base.z);
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const int i = corner & 1, j = (corner >> 1) & 1, k = corner >> 2;
        const double weight = (i == 1 ? s.x : 1 - s.x) * (j == 1 ? s.y : 1 - s.y) * (k == 1 ? s.z : 1 - s.z);
        sum += weight * lattice(x + i, y + j, z + k);
    }
    return sum;
}

// First intersection of a ray from `origin` with the drum.
inline std::optional<glm::dvec3> hit(const Drum& drum, const glm::dvec3& origin, const glm::dvec3& d) {
    const double a = d.x * d.x + d.z * d.z;
    const double b = origin.x * d.x + origin.z * d.z;
    const double under = b * b - a * (origin.x * origin.x + origin.z * origin.z - drum.radius * drum.radius);
    const double low = drum.middle - drum.height / 2, high = drum.middle + drum.height / 2;
    if (under > 0 && a > 0) {
        const glm::dvec3 p = origin + (-b - std::sqrt(under)) / a * d;
        if (p.y >= low && p.y <= high) return p;
    }
    if (d.y < 0 && origin.y > high) {
        const glm::dvec3 p = origin + (high - origin.y) / d.y * d;
        if (p.x * p.x + p.z * p.z <= drum.radius * drum.radius) return p;
    }
    return std::nullopt;
}

// Linear intensity.
inline glm::dvec3 colour(const Drum& drum, const glm::dvec3& p) {
    if (!drum.is_spotted) return {0.32, 0.18, 0.1};
    const glm::dvec3 q = p / drum.grain + glm::dvec3(50.3);
    const double light = 0.3 + 0.26 * noise(q) + 0.14 * noise(2.3 * q + glm::dvec3(17.7));
    const double red = 0.5 * noise(0.7 * q + glm::dvec3(5.5));
    const double l = std::clamp(light, 0.02, 0.65);
    return glm::clamp(glm::dvec3(l * (1 + red), 0.8 * l, 0.7 * l * (1 - red)), 0.01, 0.9);
}

}  // namespace drum

// Rendered view `view` of the drum, straight alpha; 3 x 3 rays per pixel.
inline Image<Rgba8> drawn_drum(const Drum& drum, const capture::TurntableModel& model, std::size_t view) {
    constexpr int kSide = 3;
    const double angle = model.angles_rad[view];
    const glm::dvec3 origin = capture::turned({0, 0, 1}, -angle);
    Image<Rgba8> image(model.lens.width, model.lens.height);
    const capture::TableRays rays(model.lens, model.pose, -angle);
    for_each_index(image.height(), [&](int y) {
        for (int x = 0; x < image.width(); ++x) {
            glm::dvec3 sum(0.0);
            int inside = 0;
            for (int s = 0; s < kSide * kSide; ++s) {
                const glm::dvec2 p(x + (s % kSide + 0.5) / kSide, y + (s / kSide + 0.5) / kSide);
                const auto ray = rays.through(p);
                if (!ray) continue;
                const auto met = drum::hit(drum, origin, *ray);
                if (!met) continue;
                sum += drum::colour(drum, *met);
                ++inside;
            }
            if (inside == 0) continue;
            const auto code = [&](double light) { return srgb8_from_linear(static_cast<float>(light / inside)); };
            image(x, y) = {code(sum.x), code(sum.y), code(sum.z),
                           static_cast<std::uint8_t>(std::lround(255.0 * inside / (kSide * kSide)))};
        }
    });
    return image;
}

// 320 x 256 px, 20 degrees from above, the drum half as wide as the image.
inline capture::TurntableModel drum_turn(int views, double step_rad) {
    capture::TurntableModel model;
    model.lens = {320, 256, 620, 160, 128, 0, 0};
    model.pose = {0.012, radians(20), 0.01};
    for (int i = 0; i < views; ++i) model.angles_rad.push_back(i * step_rad);
    return model;
}

}  // namespace rs::test
