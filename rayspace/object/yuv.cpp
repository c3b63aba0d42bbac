#include "rayspace/object/yuv.hpp"

#include <cmath>

namespace rs {
namespace {

std::uint8_t rounded(double value) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
}

}  // namespace

PlanarImage planar_from_rgba(ConstImageView<Rgba8> image) {
    const int width = image.width();
    const int height = image.height();
    PlanarImage planar;
    planar.y = Image<std::uint8_t>(width, height);
    planar.a = Image<std::uint8_t>(width, height);
    planar.u = Image<std::uint8_t>(half_size(width), half_size(height), 128);
    planar.v = Image<std::uint8_t>(half_size(width), half_size(height), 128);

    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const Rgba8 p = image(x, y);
            planar.a(x, y) = p.a;
            if (p.a != 0) planar.y(x, y) = rounded(0.299 * p.r + 0.587 * p.g + 0.114 * p.b);
        }
    }
    for (int y = 0; y < planar.u.height(); ++y) {
        for (int x = 0; x < planar.u.width(); ++x) {
            double weight = 0, r = 0, g = 0, b = 0;
            for (int yy = 2 * y; yy < std::min(2 * y + 2, height); ++yy) {
                for (int xx = 2 * x; xx < std::min(2 * x + 2, width); ++xx) {
                    const Rgba8 p = image(xx, yy);
                    weight += p.a;
                    r += p.a * p.r;
                    g += p.a * p.g;
                    b += p.a * p.b;
                }
            }
            if (weight == 0) continue;
            const double luma = 0.299 * r + 0.587 * g + 0.114 * b;
            planar.u(x, y) = rounded(128 + (b - luma) / weight / 1.772);
            planar.v(x, y) = rounded(128 + (r - luma) / weight / 1.402);
        }
    }
    return planar;
}

Image<Rgba8> rgba_from_planar(const PlanarImage& image) {
    Image<Rgba8> result(image.y.width(), image.y.height());
    for (int y = 0; y < result.height(); ++y) {
        for (int x = 0; x < result.width(); ++x) result(x, y) = rgba_at(image, x, y);
    }
    return result;
}

}  // namespace rs
