#include "compositor/viewer/drawing/object_cartoon.hpp"

#include "rayspace/base/parallel.hpp"
#include "rayspace/image/linear_light.hpp"
#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace rs::compositor {
namespace {

constexpr int kMaxReach_px = 8;
constexpr int kOpaqueCode = 128;

// CIE 1976 lightness / 100 of a relative luminance, and its inverse.
float lightness_of(float luminance) {
    return luminance > 216.0F / 24389 ? 1.16F * std::cbrt(luminance) - 0.16F : luminance * (24389.0F / 2700);
}
float luminance_of(float lightness) {
    const float root = (lightness + 0.16F) / 1.16F;
    return lightness > 0.08F ? root * root * root : lightness * (2700.0F / 24389);
}

glm::vec3 codes_of(const RgbaF& p) {
    return {p.r, p.g, p.b};
}

// Bilateral filter of sRGB codes, weighted by alpha. OpenCV's would mix in the colours of transparent pixels, which
// have none.
Image<RgbaF> filtered_codes(const Image<RgbaF>& image, int reach) {
    constexpr float kCodes = 35;  // standard deviation of differences that are smoothed: fur and fabric
    const float sigma = 0.5F * static_cast<float>(reach);
    Image<RgbaF> result(image.width(), image.height());
    for_each_index(image.height(), 0, [&](std::int64_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < image.width(); ++x) {
            const RgbaF& middle = image(x, y);
            if (!(middle.a > 0)) continue;
            glm::vec3 sum(0);
            float weights = 0;
            for (int v = std::max(y - reach, 0); v <= std::min(y + reach, image.height() - 1); ++v) {
                for (int u = std::max(x - reach, 0); u <= std::min(x + reach, image.width() - 1); ++u) {
                    const RgbaF& p = image(u, v);
                    if (!(p.a > 0)) continue;
                    const glm::vec3 d = (codes_of(p) - codes_of(middle)) / kCodes;
                    const glm::vec2 away = glm::vec2(u - x, v - y) / sigma;
                    const float weight = p.a * std::exp(-0.5F * (glm::dot(d, d) + glm::dot(away, away)));
                    sum += weight * codes_of(p);
                    weights += weight;
                }
            }
            sum /= weights;
            result(x, y) = {sum.r, sum.g, sum.b, middle.a};
        }
    });
    return result;
}

// Iterated, for regions of one tone that textures do not break up.
Image<RgbaF> smoothed(const Image<Rgba8>& image, int reach) {
    constexpr int kIterations = 3;
    Image<RgbaF> codes(image.width(), image.height());
    std::ranges::transform(image.pixels(), codes.pixels().begin(), [](Rgba8 p) {
        return RgbaF{static_cast<float>(p.r), static_cast<float>(p.g), static_cast<float>(p.b),
                     static_cast<float>(p.a)};
    });
    for (int i = 0; i < kIterations; ++i) codes = filtered_codes(codes, reach);
    return codes;
}

// Steps with narrow ramps, which do not flicker.
float tone_of(const ObjectCartoon& style, float lightness) {
    constexpr float kRamp = 0.015F;  // half width
    float tone = style.values.back();
    for (std::size_t i = style.thresholds.size(); i-- > 0;) {
        const float part = std::clamp((lightness - style.thresholds[i]) / (2 * kRamp) + 0.5F, 0.0F, 1.0F);
        tone += part * (style.values[i] - style.values[i + 1]);
    }
    return tone;
}

// The linear colour with another luminance and the same hue.
glm::vec3 with_luminance(const glm::vec3& colour, float wanted) {
    constexpr float kMaxFactor = 3;  // more would amplify the noise of dark colours; the rest is grey
    const float own = luminance(colour);
    const float factor = std::min(wanted / std::max(own, 1e-6F), kMaxFactor);
    const glm::vec3 scaled = colour * factor + (wanted - own * factor);
    const float greatest = max_component(scaled);
    if (greatest <= 1) return scaled;
    // Towards grey of the same luminance, into the gamut.
    const float part = (1 - wanted) / std::max(greatest - wanted, 1e-6F);
    return glm::mix(glm::vec3(wanted), scaled, std::clamp(part, 0.0F, 1.0F));
}

// Share of the pixel that the line covers, which extends inwards from the silhouette.
float line_coverage(const Image<Rgba8>& image, int x, int y, float width) {
    const int reach = static_cast<int>(std::ceil(width + 0.5F));
    float nearest2 = static_cast<float>((reach + 1) * (reach + 1));
    for (int v = std::max(y - reach, 0); v <= std::min(y + reach, image.height() - 1); ++v) {
        for (int u = std::max(x - reach, 0); u <= std::min(x + reach, image.width() - 1); ++u) {
            if (image(u, v).a >= kOpaqueCode) continue;
            nearest2 = std::min(nearest2, static_cast<float>((u - x) * (u - x) + (v - y) * (v - y)));
        }
    }
    return std::clamp(width + 1 - std::sqrt(nearest2), 0.0F, 1.0F);
}

}  // namespace

Image<Rgba8> cartoon_of(const Image<Rgba8>& image, const ObjectCartoon& style, double pixel, double line_px) {
    const int reach = std::clamp(static_cast<int>(std::lround(4 * pixel)), 2, kMaxReach_px);
    const Image<RgbaF> smooth = smoothed(image, reach);
    const auto width = static_cast<float>(std::min(line_px, 32.0));
    Image<Rgba8> cartoon(image.width(), image.height());
    for_each_index(image.height(), 0, [&](std::int64_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < image.width(); ++x) {
            const RgbaF& p = smooth(x, y);
            if (!(p.a > 0)) continue;
            const glm::vec3 colour(linear_from_srgb(p.r / 255), linear_from_srgb(p.g / 255),
                                   linear_from_srgb(p.b / 255));
            glm::vec3 drawn = with_luminance(colour, luminance_of(tone_of(style, lightness_of(luminance(colour)))));
            if (width > 0) drawn = glm::mix(drawn, style.line_colour, line_coverage(image, x, y, width));
            cartoon(x, y) = {srgb8_by_table(drawn.r), srgb8_by_table(drawn.g), srgb8_by_table(drawn.b), image(x, y).a};
        }
    });
    return cartoon;
}

}  // namespace rs::compositor
