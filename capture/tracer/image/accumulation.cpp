#include "capture/tracer/image/accumulation.hpp"

#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <utility>

namespace rs::capture {

namespace {

template <class Pixel>
Image<Pixel> cropped(const Image<Pixel>& image, const PixelRectangle& part) {
    Image<Pixel> result(part.x1 - part.x0, part.y1 - part.y0);
    for (int y = part.y0; y < part.y1; ++y) {
        for (int x = part.x0; x < part.x1; ++x) result(x - part.x0, y - part.y0) = image(x, y);
    }
    return result;
}

}  // namespace

PixelRectangle overlap(const PixelRectangle& a, const PixelRectangle& b) {
    return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

Accumulation Accumulation::crop(const PixelRectangle& part) const {
    return {cropped(sum, part), samples, guides.empty() ? Image<GuideSum>() : cropped(guides, part)};
}

void Accumulation::add(int x, int y, const RadianceSample& sample) {
    RgbaF& pixel = sum(x, y);
    pixel.r += sample.radiance.r;
    pixel.g += sample.radiance.g;
    pixel.b += sample.radiance.b;
    pixel.a += 1.0F;
    if (guides.empty()) return;
    GuideSum& guide_sum = guides(x, y);
    const float l = luminance(sample.radiance);
    guide_sum.squares += l * l;
    if (!sample.has_guide) return;
    guide_sum.sum.position += sample.guide.position;
    guide_sum.sum.normal += sample.guide.normal;
    guide_sum.sum.colour += sample.guide.colour;
    guide_sum.sum.distance += sample.guide.distance;
    guide_sum.count += 1.0F;
}

Image<RgbaF> Accumulation::mean() const& {
    return Accumulation{sum, samples, {}}.mean();  // without the guides, which are large
}

Image<RgbaF> Accumulation::mean() && {
    for (RgbaF& s : sum.pixels()) {
        if (s.a > 0.0F) s = {s.r / s.a, s.g / s.a, s.b / s.a, s.a / static_cast<float>(samples)};
    }
    return std::move(sum);
}

}  // namespace rs::capture
