#pragma once
// Synthetic turn: a textured disc that orbits the axis in front of a background, with ground-truth alpha. Composited in
// linear light.

#include "rayspace/base/conventions.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rs::test {

struct DrawnView {
    Image<Rgba8> photo;       // composited over the background, opaque
    Image<float> alpha;       // ground truth, 0..1
    Image<Rgba8> foreground;  // ground truth: the disc's own colour, at every pixel
};

struct DrawnTurn {
    int width = 160;
    int height = 120;
    int views = 12;
    double axis_x_px = 83;
    double orbit_px = 38;  // amplitude of the disc's centre
    double radius_px = 20;
    Rgba8 backdrop{255, 255, 255, 255};
    double shadow = 0;  // share of the light that a soft shadow below the disc takes, 0..1
};

inline Rgba8 mixed(const Rgba8& f, const Rgba8& b, double alpha) {
    const auto mix = [&](std::uint8_t x, std::uint8_t y) {
        return srgb8_from_linear(static_cast<float>(alpha * linear_from_srgb8(x) + (1 - alpha) * linear_from_srgb8(y)));
    };
    return {mix(f.r, b.r), mix(f.g, b.g), mix(f.b, b.b), 255};
}

// View i of the turn: the disc is at azimuth 360 i / views degrees.
inline DrawnView draw_view(const DrawnTurn& turn, int i) {
    DrawnView view{Image<Rgba8>(turn.width, turn.height), Image<float>(turn.width, turn.height),
                   Image<Rgba8>(turn.width, turn.height)};
    const double centre_x = turn.axis_x_px + turn.orbit_px * std::sin(2 * kPi * i / turn.views);
    const double centre_y = turn.height / 2.0;
    for (int y = 0; y < turn.height; ++y) {
        for (int x = 0; x < turn.width; ++x) {
            const double dx = x + 0.5 - centre_x;
            const double dy = y + 0.5 - centre_y;
            // Coverage of the pixel by the disc: a linear ramp over one pixel across the circle.
            const double alpha = std::clamp(turn.radius_px - std::hypot(dx, dy) + 0.5, 0.0, 1.0);
            const double stripe = std::sin(0.5 * dx + i) * std::sin(0.4 * dy);
            const Rgba8 own{static_cast<std::uint8_t>(190 + 12 * stripe), static_cast<std::uint8_t>(90 - 8 * stripe),
                            40, 255};
            const double below = std::hypot(dx / 24, (dy - turn.radius_px - 6) / 8);
            const double light = 1 - turn.shadow * std::exp(-below * below);
            const Rgba8 behind = mixed(turn.backdrop, {0, 0, 0, 255}, light);
            view.alpha(x, y) = static_cast<float>(alpha);
            view.foreground(x, y) = own;
            view.photo(x, y) = mixed(own, behind, alpha);
        }
    }
    return view;
}

inline std::vector<Image<Rgba8>> draw_photos(const DrawnTurn& turn) {
    std::vector<Image<Rgba8>> photos;
    for (int i = 0; i < turn.views; ++i) photos.push_back(draw_view(turn, i).photo);
    return photos;
}

}  // namespace rs::test
