#include "capture/photos/intake/colour_difference.hpp"

#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <cmath>

namespace rs::capture {
namespace {

float lab_curve(float t) {
    return t > 216.0F / 24389 ? std::cbrt(t) : (24389.0F / 27 * t + 16) / 116;
}

}  // namespace

LinearRgb linear_rgb(const Rgba8& srgb) {
    return {linear_from_srgb8(srgb.r), linear_from_srgb8(srgb.g), linear_from_srgb8(srgb.b)};
}

Lab lab_from_linear(const LinearRgb& c) {
    // sRGB primaries to XYZ, each divided by the white point's (IEC 61966-2-1).
    const float x = lab_curve((0.4124F * c.r + 0.3576F * c.g + 0.1805F * c.b) / 0.9505F);
    const float y = lab_curve(0.2126F * c.r + 0.7152F * c.g + 0.0722F * c.b);
    const float z = lab_curve((0.0193F * c.r + 0.1192F * c.g + 0.9505F * c.b) / 1.0890F);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

float delta_e(const Lab& x, const Lab& y) {
    return std::hypot(x.l - y.l, x.a - y.a, x.b - y.b);
}

bool is_colourful(const LinearRgb& colour) {
    constexpr float kColourful = 15;
    const Lab lab = lab_from_linear(colour);
    return std::hypot(lab.a, lab.b) > kColourful;
}

Explanation explain_by_backdrop(const LinearRgb& pixel, const LinearRgb& backdrop, float min_shade, float max_shade) {
    const Lab seen = lab_from_linear(pixel);
    Explanation result;
    result.plain = delta_e(seen, lab_from_linear(backdrop));
    const float energy = backdrop.r * backdrop.r + backdrop.g * backdrop.g + backdrop.b * backdrop.b;
    const float overlap = pixel.r * backdrop.r + pixel.g * backdrop.g + pixel.b * backdrop.b;
    result.shade = std::clamp(energy > 0 ? overlap / energy : 1.0F, min_shade, max_shade);
    result.shaded =
        std::min(result.plain, delta_e(seen, lab_from_linear({result.shade * backdrop.r, result.shade * backdrop.g,
                                                              result.shade * backdrop.b})));
    return result;
}

}  // namespace rs::capture
