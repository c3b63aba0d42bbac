#include "tests/bench/rd/background.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rs::bench {
namespace {

// sRGB values multiplied by a weight, which is in `a`.
using Weighted = Image<RgbaF>;

Weighted halved(const Weighted& fine) {
    Weighted coarse((fine.width() + 1) / 2, (fine.height() + 1) / 2);
    for (int y = 0; y < fine.height(); ++y) {
        for (int x = 0; x < fine.width(); ++x) {
            const RgbaF& p = fine(x, y);
            RgbaF& sum = coarse(x / 2, y / 2);
            sum.r += p.r;
            sum.g += p.g;
            sum.b += p.b;
            sum.a += p.a;
        }
    }
    // Weights are limited to 1; otherwise larger areas would dominate nearer ones.
    for (RgbaF& p : coarse.pixels()) {
        if (p.a <= 1) continue;
        p = {p.r / p.a, p.g / p.a, p.b / p.a, 1};
    }
    return coarse;
}

// Bilinear value of `coarse`, whose weights are all 1, at the centre of pixel (x, y) of the next finer level.
RgbaF between(const Weighted& coarse, int x, int y) {
    const int x0 = std::clamp((x - 1) >> 1, 0, coarse.width() - 1);
    const int y0 = std::clamp((y - 1) >> 1, 0, coarse.height() - 1);
    const int x1 = std::min(((x - 1) >> 1) + 1, coarse.width() - 1);
    const int y1 = std::min(((y - 1) >> 1) + 1, coarse.height() - 1);
    const float u = x % 2 == 0 ? 0.75F : 0.25F;
    const float v = y % 2 == 0 ? 0.75F : 0.25F;
    const auto mix = [&](float RgbaF::*c) {
        return (1 - v) * ((1 - u) * coarse(x0, y0).*c + u * coarse(x1, y0).*c) +
               v * ((1 - u) * coarse(x0, y1).*c + u * coarse(x1, y1).*c);
    };
    return {mix(&RgbaF::r), mix(&RgbaF::g), mix(&RgbaF::b), 1};
}

// Fills pixels of `fine` up to weight 1.
void fill_from(const Weighted& coarse, Weighted& fine) {
    for (int y = 0; y < fine.height(); ++y) {
        for (int x = 0; x < fine.width(); ++x) {
            RgbaF& p = fine(x, y);
            if (p.a >= 1) continue;
            const RgbaF q = between(coarse, x, y);
            const float missing = 1 - p.a;
            p = {p.r + missing * q.r, p.g + missing * q.g, p.b + missing * q.b, 1};
        }
    }
}

Image<Rgba8> with_spread_colours(ConstImageView<Rgba8> image) {
    std::vector<Weighted> pyramid;
    pyramid.emplace_back(image.width(), image.height());
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const Rgba8& p = image(x, y);
            if (p.a > 0) pyramid[0](x, y) = {float(p.r), float(p.g), float(p.b), 1};
        }
    }
    while (pyramid.back().width() > 1 || pyramid.back().height() > 1) pyramid.push_back(halved(pyramid.back()));
    RgbaF& top = pyramid.back()(0, 0);
    top = top.a > 0 ? RgbaF{top.r / top.a, top.g / top.a, top.b / top.a, 1} : RgbaF{0, 0, 0, 1};
    for (std::size_t level = pyramid.size() - 1; level-- > 0;) fill_from(pyramid[level + 1], pyramid[level]);
    Image<Rgba8> filled(image.width(), image.height());
    const auto byte = [](float value) { return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.F, 255.F))); };
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const RgbaF& p = pyramid[0](x, y);
            filled(x, y) = image(x, y).a > 0 ? image(x, y) : Rgba8{byte(p.r), byte(p.g), byte(p.b), 0};
        }
    }
    return filled;
}

}  // namespace

Image<Rgba8> with_background(ConstImageView<Rgba8> image, Background background) {
    if (background == Background::kSpread) return with_spread_colours(image);
    Image<Rgba8> filled(image.width(), image.height());
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            if (image(x, y).a > 0) filled(x, y) = image(x, y);
        }
    }
    return filled;
}

Image<Rgba8> made_opaque(Image<Rgba8> image) {
    for (Rgba8& p : image.pixels()) p.a = 255;
    return image;
}

}  // namespace rs::bench
