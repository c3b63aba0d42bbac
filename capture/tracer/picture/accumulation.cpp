#include "capture/tracer/picture/accumulation.hpp"

#include "capture/tracer/light/directions.hpp"

#include <utility>

namespace rs::capture {

void Accumulation::add(int x, int y, const Arrived& arrived) {
    RgbaF& pixel = sum(x, y);
    pixel.r += arrived.radiance.r;
    pixel.g += arrived.radiance.g;
    pixel.b += arrived.radiance.b;
    pixel.a += 1.0F;
    if (guides.empty()) return;
    GuideSum& of_pixel = guides(x, y);
    const float l = luminance(arrived.radiance);
    of_pixel.squares += l * l;
    if (!arrived.guided) return;
    of_pixel.sum.place += arrived.guide.place;
    of_pixel.sum.normal += arrived.guide.normal;
    of_pixel.sum.colour += arrived.guide.colour;
    of_pixel.sum.distance += arrived.guide.distance;
    of_pixel.count += 1.0F;
}

Image<RgbaF> Accumulation::mean() const& {
    return Accumulation(*this).mean();
}

Image<RgbaF> Accumulation::mean() && {
    for (RgbaF& s : sum.pixels()) {
        if (s.a > 0.0F) s = {s.r / s.a, s.g / s.a, s.b / s.a, s.a / static_cast<float>(samples)};
    }
    return std::move(sum);
}

}  // namespace rs::capture
