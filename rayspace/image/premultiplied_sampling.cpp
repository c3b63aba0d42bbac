#include "rayspace/image/premultiplied_sampling.hpp"

#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rs {
namespace {

// Weights of the four samples around position t in 0..1 between the middle two.
std::array<float, 4> catmull_rom(float t) {
    return {((-0.5F * t + 1.0F) * t - 0.5F) * t, (1.5F * t - 2.5F) * t * t + 1.0F, ((-1.5F * t + 2.0F) * t + 0.5F) * t,
            (0.5F * t - 0.5F) * t * t};
}

struct Premultiplied {
    float r = 0, g = 0, b = 0, a = 0;
};

Premultiplied premultiplied(const Rgba8& p) {
    const float a = static_cast<float>(p.a) / 255.0F;
    return {linear_from_srgb8(p.r) * a, linear_from_srgb8(p.g) * a, linear_from_srgb8(p.b) * a, a};
}

Rgba8 straight(const Premultiplied& p) {
    const auto alpha = static_cast<std::uint8_t>(std::lround(std::clamp(p.a, 0.0F, 1.0F) * 255.0F));
    if (alpha == 0) return {};
    // Divided by the alpha as it is: the kernel overshoots 1 just inside of an edge, and the colour with it.
    return {srgb8_from_linear(p.r / p.a), srgb8_from_linear(p.g / p.a), srgb8_from_linear(p.b / p.a), alpha};
}

}  // namespace

Rgba8 sample_premultiplied(ConstImageView<Rgba8> picture, double x, double y) {
    const double left = std::floor(x - 0.5);
    const double top = std::floor(y - 0.5);
    const auto weight_x = catmull_rom(static_cast<float>(x - 0.5 - left));
    const auto weight_y = catmull_rom(static_cast<float>(y - 0.5 - top));
    Premultiplied sum;
    for (int dy = 0; dy < 4; ++dy) {
        const int row = static_cast<int>(top) - 1 + dy;
        if (row < 0 || row >= picture.height()) continue;
        for (int dx = 0; dx < 4; ++dx) {
            const int column = static_cast<int>(left) - 1 + dx;
            if (column < 0 || column >= picture.width()) continue;
            const Premultiplied p = premultiplied(picture(column, row));
            const float w = weight_x[static_cast<std::size_t>(dx)] * weight_y[static_cast<std::size_t>(dy)];
            sum.r += w * p.r;
            sum.g += w * p.g;
            sum.b += w * p.b;
            sum.a += w * p.a;
        }
    }
    return straight(sum);
}

}  // namespace rs
