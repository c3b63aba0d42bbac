#pragma once
// Masks of bodies of ellipsoids on a turntable.

#include "capture/calibration/model/turntable_model.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace rs::capture {

struct Ellipsoid {  // in the object frame, units of the camera's distance
    glm::dvec3 centre{0};
    glm::dvec3 radii{0};
};

// A body without any symmetry about the axis: trunk, arm, head, foot.
inline std::vector<Ellipsoid> figure() {
    return {{{0.01, -0.30, 0.0}, {0.09, 0.13, 0.06}},
            {{0.10, -0.27, 0.03}, {0.08, 0.025, 0.03}},
            {{-0.03, -0.16, 0.05}, {0.04, 0.045, 0.04}},
            {{-0.05, -0.40, -0.06}, {0.06, 0.03, 0.08}}};
}

// A body of revolution: its silhouette does not change.
inline std::vector<Ellipsoid> bottle() {
    return {{{0, -0.30, 0}, {0.09, 0.13, 0.09}}, {{0, -0.17, 0}, {0.035, 0.1, 0.035}}};
}

inline TurntableModel turn_of_figure(int views) {
    TurntableModel model;
    model.lens = {320, 240, 420, 160, 120, 0, 0};
    // The axis is 12 px to the right of the image centre.
    model.pose = {std::atan(-12.0 / 420), radians(15), radians(1)};
    for (int i = 0; i < views; ++i) model.angles_rad.push_back(2 * kPi * i / views);
    return model;
}

inline bool hits(const std::vector<Ellipsoid>& body, const glm::dvec3& origin, const glm::dvec3& direction) {
    for (const Ellipsoid& part : body) {
        const glm::dvec3 o = (origin - part.centre) / part.radii;
        const glm::dvec3 d = direction / part.radii;
        const double b = glm::dot(o, d);
        if (b * b >= glm::dot(d, d) * (glm::dot(o, o) - 1)) return true;
    }
    return false;
}

inline std::vector<Image<std::uint8_t>> drawn(const std::vector<Ellipsoid>& body, const TurntableModel& model) {
    constexpr int kMaskSamples = 3;  // per side of a pixel
    std::vector<Image<std::uint8_t>> masks;
    for (const double angle : model.angles_rad) {
        const glm::dvec3 origin = turned({0, 0, 1}, -angle);
        Image<std::uint8_t> mask(model.lens.width, model.lens.height);
        const TableRays rays(model.lens, model.pose, -angle);
        for (int y = 0; y < mask.height(); ++y) {
            for (int x = 0; x < mask.width(); ++x) {
                int inside = 0;
                for (int s = 0; s < kMaskSamples * kMaskSamples; ++s) {
                    const glm::dvec2 p(x + (s % kMaskSamples + 0.5) / kMaskSamples,
                                       y + (s / kMaskSamples + 0.5) / kMaskSamples);
                    const auto ray = rays.through(p);
                    if (ray && hits(body, origin, *ray)) ++inside;
                }
                mask(x, y) = static_cast<std::uint8_t>(inside * 255 / (kMaskSamples * kMaskSamples));
            }
        }
        masks.push_back(std::move(mask));
    }
    return masks;
}

}  // namespace rs::capture
