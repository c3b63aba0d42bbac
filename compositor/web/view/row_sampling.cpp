#include "compositor/web/view/row_sampling.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

namespace rs::web {
namespace {

constexpr double kRollTolerance = 1e-9;
constexpr std::int32_t kOutside_q8 = -(1 << 20);

Rgba8 sample_bilinear(ConstImageView<Rgba8> image, std::int32_t x_q8, std::int32_t y_q8) {
    const int left = x_q8 >> 8;
    const int top = y_q8 >> 8;
    if (left < -1 || top < -1 || left >= image.width() || top >= image.height()) return {};
    const auto fraction_x = static_cast<std::uint32_t>(x_q8 & 255);
    const auto fraction_y = static_cast<std::uint32_t>(y_q8 & 255);
    std::uint32_t r = 0;
    std::uint32_t g = 0;
    std::uint32_t b = 0;
    std::uint32_t a = 0;
    for (int n = 0; n < 4; ++n) {
        const int column = left + (n & 1);
        const int row = top + (n >> 1);
        if (column < 0 || row < 0 || column >= image.width() || row >= image.height()) continue;
        const Rgba8 p = image(column, row);
        const std::uint32_t weight =
            ((n & 1) != 0 ? fraction_x : 256 - fraction_x) * ((n & 2) != 0 ? fraction_y : 256 - fraction_y) * p.a >> 8;
        r += weight * p.r;
        g += weight * p.g;
        b += weight * p.b;
        a += weight;
    }
    if (a == 0) return {};
    const auto channel = [&](std::uint32_t sum) { return static_cast<std::uint8_t>((sum + a / 2) / a); };
    return {channel(r), channel(g), channel(b), static_cast<std::uint8_t>((a + 128) >> 8)};
}

constexpr const char* kPresent = R"glsl(#version 300 es
precision highp float;
precision highp int;
uniform highp usampler2D image;
uniform highp usampler2D second;
uniform int weight;
uniform highp isampler2D rows;
uniform ivec2 image_size;
uniform int height;
uniform int is_sampled;
out vec4 colour;

// mix_pixels() of engine/core/definition/mix_rings.hpp.
uvec4 pixel_at(ivec2 at) {
    uvec4 nearest = texelFetch(image, at, 0);
    if (weight == 0) return nearest;
    uvec4 other = texelFetch(second, at, 0);
    uint a = nearest.a * uint(256 - weight);
    uint b = other.a * uint(weight);
    uint alpha = (a + b + 128u) >> 8;
    if (alpha == 0u) return uvec4(0u);
    return uvec4((nearest.rgb * a + other.rgb * b + ((a + b) >> 1)) / (a + b), alpha);
}

// The sums of resample(): r, g, b, a.
void add_tap(inout uvec4 sum, ivec2 at, uint weight) {
    if (at.x < 0 || at.y < 0 || at.x >= image_size.x || at.y >= image_size.y) return;
    uvec4 p = pixel_at(at);
    uint w = (weight * p.a) >> 8;
    sum += w * uvec4(p.rgb, 1u);
}

uvec4 sampled(ivec2 pixel) {
    ivec4 row = texelFetch(rows, ivec2(0, pixel.y), 0);
    int x_q8 = (row.x + pixel.x * row.y) >> 8;
    ivec2 at = ivec2(x_q8 >> 8, row.z >> 8);
    uint fx = uint(x_q8 & 255);
    uint fy = uint(row.z & 255);
    uvec4 sum = uvec4(0u);
    add_tap(sum, at, (256u - fx) * (256u - fy));
    add_tap(sum, at + ivec2(1, 0), fx * (256u - fy));
    add_tap(sum, at + ivec2(0, 1), (256u - fx) * fy);
    add_tap(sum, at + ivec2(1, 1), fx * fy);
    if (sum.a == 0u) return uvec4(0u);
    return uvec4((sum.rgb + (sum.a >> 1)) / sum.a, (sum.a + 128u) >> 8);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    pixel.y = height - 1 - pixel.y;
    uvec4 straight = is_sampled == 1 ? sampled(pixel) : pixel_at(pixel);
    uvec3 premultiplied = (straight.rgb * straight.a + 127u) / 255u;
    colour = vec4(premultiplied, straight.a) / 255.0;
}
)glsl";

}  // namespace

std::optional<std::vector<SampledRow>> sampled_rows(const glm::dmat3& image_from_screen, int width, int height) {
    const glm::dvec3 across = image_from_screen[0];
    if (std::abs(across.y) > kRollTolerance || std::abs(across.z) > kRollTolerance) return std::nullopt;
    std::vector<SampledRow> rows;
    for (int j = 0; j < height; ++j) {
        const glm::dvec3 at = image_from_screen * glm::dvec3(0.5, j + 0.5, 1);
        SampledRow& row = rows.emplace_back();
        row.y_q8 = kOutside_q8;
        if (!(at.z > 0)) continue;
        const double x = at.x / at.z - 0.5;
        const double step = across.x / at.z;
        const double y = at.y / at.z - 0.5;
        constexpr double kLimit = std::numeric_limits<std::int32_t>::max() / 65536.0;
        if (!(std::abs(x) + width * std::abs(step) < kLimit && std::abs(y) < kLimit)) return std::nullopt;
        row.x_q16 = static_cast<std::int32_t>(std::lround(x * 65536));
        row.step_q16 = static_cast<std::int32_t>(std::lround(step * 65536));
        row.y_q8 = static_cast<std::int32_t>(std::floor(y * 256));
    }
    return rows;
}

void resample(ConstImageView<Rgba8> from, const std::vector<SampledRow>& rows, ImageView<Rgba8> to) {
    for (int j = 0; j < to.height(); ++j) {
        const SampledRow& row = rows[static_cast<std::size_t>(j)];
        for (int i = 0; i < to.width(); ++i) {
            to(i, j) = sample_bilinear(from, (row.x_q16 + i * row.step_q16) >> 8, row.y_q8);
        }
    }
}

std::string present_shader() {
    return kPresent;
}

}  // namespace rs::web
