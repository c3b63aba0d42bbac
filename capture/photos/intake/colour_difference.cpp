#include "capture/photos/intake/colour_difference.hpp"

#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace rs::capture {
namespace {

// Cube root of 0.008 <= t < 10 within 1 ulp: two Halley steps from an initial value with a third of the exponent.
float cube_root(float t) {
    constexpr std::uint32_t kThirdOfBias = 709921077;
    float root = std::bit_cast<float>(std::bit_cast<std::uint32_t>(t) / 3 + kThirdOfBias);
    for (int step = 0; step < 2; ++step) {
        const float cube = root * root * root;
        root *= (cube + 2 * t) / (2 * cube + t);
    }
    return root;
}

float lab_curve(float t) {
    return t > 216.0F / 24389 ? cube_root(t) : (24389.0F / 27 * t + 16) * (1.0F / 116);
}

bool same(const Rgba8& a, const Rgba8& b) {
    return a == b;
}
bool same(const LinearRgb& a, const LinearRgb& b) {
    return a.r == b.r && a.g == b.g && a.b == b.b;
}

template <class Pixel, class ToLinear>
Image<Lab> convert_to_lab(ConstImageView<Pixel> image, ToLinear to_linear) {
    Image<Lab> lab(image.width(), image.height());
    for (int y = 0; y < image.height(); ++y) {
        const Pixel* const from = image.row(y);
        Lab* const to = lab.row(y);
        for (int x = 0; x < image.width(); ++x) {
            // Backgrounds are uniform: reuse the conversion of an equal neighbour.
            to[x] = x > 0 && same(from[x], from[x - 1]) ? to[x - 1] : lab_from_linear(to_linear(from[x]));
        }
    }
    return lab;
}

}  // namespace

LinearRgb linear_rgb(const Rgba8& srgb) {
    return {linear_from_srgb8(srgb.r), linear_from_srgb8(srgb.g), linear_from_srgb8(srgb.b)};
}

Lab lab_from_linear(const LinearRgb& c) {
    // sRGB primaries to XYZ relative to the white point (IEC 61966-2-1).
    const float x = lab_curve((0.4124F * c.r + 0.3576F * c.g + 0.1805F * c.b) * (1 / 0.9505F));
    const float y = lab_curve(0.2126F * c.r + 0.7152F * c.g + 0.0722F * c.b);
    const float z = lab_curve((0.0193F * c.r + 0.1192F * c.g + 0.9505F * c.b) * (1 / 1.0890F));
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Image<Lab> lab_image(ConstImageView<Rgba8> image) {
    return convert_to_lab<Rgba8>(image, [](const Rgba8& p) { return linear_rgb(p); });
}

Image<Lab> lab_image(ConstImageView<LinearRgb> image) {
    return convert_to_lab<LinearRgb>(image, [](const LinearRgb& p) { return p; });
}

float delta_e(const Lab& x, const Lab& y) {
    return std::sqrt((x.l - y.l) * (x.l - y.l) + (x.a - y.a) * (x.a - y.a) + (x.b - y.b) * (x.b - y.b));
}

bool is_colourful(const LinearRgb& colour) {
    return is_colourful(lab_from_linear(colour));
}

bool is_colourful(const Lab& colour) {
    constexpr float kMinChroma = 15;
    return colour.a * colour.a + colour.b * colour.b > kMinChroma * kMinChroma;
}

ShadowFit fit_shadow(const LinearRgb& pixel, const LinearRgb& background, float min_shade, float max_shade) {
    return fit_shadow(ColourSample(pixel), ColourSample(background), min_shade, max_shade, -1);
}

ShadowFit fit_shadow(const ColourSample& pixel, const ColourSample& background, float min_shade, float max_shade,
                     float skip_delta_e) {
    ShadowFit result;
    result.plain = result.shaded = delta_e(pixel.lab, background.lab);
    const LinearRgb& p = pixel.light;
    const LinearRgb& b = background.light;
    const float energy = b.r * b.r + b.g * b.g + b.b * b.b;
    const float overlap = p.r * b.r + p.g * b.g + p.b * b.b;
    result.shade = std::clamp(energy > 0 ? overlap / energy : 1.0F, min_shade, max_shade);
    if (result.plain <= skip_delta_e) return result;
    const Lab shaded = lab_from_linear({result.shade * b.r, result.shade * b.g, result.shade * b.b});
    result.shaded = std::min(result.plain, delta_e(pixel.lab, shaded));
    return result;
}

}  // namespace rs::capture
