#include "capture/photos/intake/colour_difference.hpp"

#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace rs::capture {
namespace {

// Of numbers from 0.008 to a few: Halley's method from the exponent's third, to the last bit or the one before.
float cube_root(float t) {
    constexpr std::uint32_t kThirdOfBias = 709921077;
    float root = std::bit_cast<float>(std::bit_cast<std::uint32_t>(t) / 3 + kThirdOfBias);
    for (int round = 0; round < 2; ++round) {
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
Image<Lab> looks_of(ConstImageView<Pixel> picture, ToLinear to_linear) {
    Image<Lab> looks(picture.width(), picture.height());
    for (int y = 0; y < picture.height(); ++y) {
        const Pixel* const from = picture.row(y);
        Lab* const to = looks.row(y);
        for (int x = 0; x < picture.width(); ++x) {
            // Backdrops are even: the same again is the same.
            to[x] = x > 0 && same(from[x], from[x - 1]) ? to[x - 1] : lab_from_linear(to_linear(from[x]));
        }
    }
    return looks;
}

}  // namespace

LinearRgb linear_rgb(const Rgba8& srgb) {
    return {linear_from_srgb8(srgb.r), linear_from_srgb8(srgb.g), linear_from_srgb8(srgb.b)};
}

Lab lab_from_linear(const LinearRgb& c) {
    // sRGB primaries to XYZ, each divided by the white point's (IEC 61966-2-1).
    const float x = lab_curve((0.4124F * c.r + 0.3576F * c.g + 0.1805F * c.b) * (1 / 0.9505F));
    const float y = lab_curve(0.2126F * c.r + 0.7152F * c.g + 0.0722F * c.b);
    const float z = lab_curve((0.0193F * c.r + 0.1192F * c.g + 0.9505F * c.b) * (1 / 1.0890F));
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Image<Lab> lab_picture(ConstImageView<Rgba8> picture) {
    return looks_of<Rgba8>(picture, [](const Rgba8& p) { return linear_rgb(p); });
}

Image<Lab> lab_picture(ConstImageView<LinearRgb> picture) {
    return looks_of<LinearRgb>(picture, [](const LinearRgb& p) { return p; });
}

float delta_e(const Lab& x, const Lab& y) {
    return std::sqrt((x.l - y.l) * (x.l - y.l) + (x.a - y.a) * (x.a - y.a) + (x.b - y.b) * (x.b - y.b));
}

bool is_colourful(const LinearRgb& colour) {
    return is_colourful(lab_from_linear(colour));
}

bool is_colourful(const Lab& colour) {
    constexpr float kColourful = 15;
    return colour.a * colour.a + colour.b * colour.b > kColourful * kColourful;
}

Explanation explain_by_backdrop(const LinearRgb& pixel, const LinearRgb& backdrop, float min_shade, float max_shade) {
    return explain_by_backdrop(KnownColour(pixel), KnownColour(backdrop), min_shade, max_shade, -1);
}

Explanation explain_by_backdrop(const KnownColour& pixel, const KnownColour& backdrop, float min_shade, float max_shade,
                                float enough_delta_e) {
    Explanation result;
    result.plain = result.shaded = delta_e(pixel.look, backdrop.look);
    const LinearRgb& p = pixel.light;
    const LinearRgb& b = backdrop.light;
    const float energy = b.r * b.r + b.g * b.g + b.b * b.b;
    const float overlap = p.r * b.r + p.g * b.g + p.b * b.b;
    result.shade = std::clamp(energy > 0 ? overlap / energy : 1.0F, min_shade, max_shade);
    if (result.plain <= enough_delta_e) return result;
    const Lab shaded = lab_from_linear({result.shade * b.r, result.shade * b.g, result.shade * b.b});
    result.shaded = std::min(result.plain, delta_e(pixel.look, shaded));
    return result;
}

bool alike_in_some_light(const LinearRgb& a, const LinearRgb& b) {
    constexpr float kUnlike_delta_e = 10;
    return explain_by_backdrop(a, b, 0.25F, 4).shaded < kUnlike_delta_e;
}

}  // namespace rs::capture
