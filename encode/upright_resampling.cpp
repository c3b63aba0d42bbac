#include "encode/upright_resampling.hpp"

#include "rayspace/linear_light.hpp"
#include "rayspace/ray_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace rs::encode {
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
    const float a = std::clamp(p.a, 0.0F, 1.0F);
    const auto alpha = static_cast<std::uint8_t>(std::lround(a * 255.0F));
    if (alpha == 0) return {};
    return {srgb8_from_linear(p.r / a), srgb8_from_linear(p.g / a), srgb8_from_linear(p.b / a), alpha};
}

Premultiplied sample(ConstImageView<Rgba8> picture, double x, double y) {
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
    return sum;
}

// [first, last) columns that hold all pixels of the row with alpha above 0.
std::optional<std::pair<int, int>> occupied_columns(std::span<const Rgba8> row) {
    const auto opaque = [](const Rgba8& p) { return p.a != 0; };
    const auto first = std::find_if(row.begin(), row.end(), opaque);
    if (first == row.end()) return std::nullopt;
    const auto last = std::find_if(row.rbegin(), row.rend(), opaque);
    return std::pair(static_cast<int>(first - row.begin()), static_cast<int>(row.rend() - last));
}

}  // namespace

void PixelBox::include(double x, double y) {
    x0 = std::min(x0, x);
    y0 = std::min(y0, y);
    x1 = std::max(x1, x);
    y1 = std::max(y1, y);
}

PixelBox occupied_box(ConstImageView<Rgba8> picture) {
    PixelBox box;
    for (int y = 0; y < picture.height(); ++y) {
        if (const auto span = occupied_columns(picture.row_span(y))) {
            box.include(span->first, y);
            box.include(span->second, y + 1);
        }
    }
    return box;
}

std::optional<PixelBox> occupied_box_seen_by(const Camera& to, const Camera& from, ConstImageView<Rgba8> picture) {
    const glm::dmat3 to_from_from = pixel_in_to_from_pixel_in_from(to, from);
    PixelBox seen;
    for (int y = 0; y < picture.height(); ++y) {
        const auto span = occupied_columns(picture.row_span(y));
        if (!span) continue;
        for (const int x : {span->first, span->second}) {
            for (const int edge : {y, y + 1}) {
                const glm::dvec3 p = to_from_from * glm::dvec3(x, edge, 1);
                if (p.z <= 0) return std::nullopt;
                seen.include(p.x / p.z, p.y / p.z);
            }
        }
    }
    return seen;
}

Image<Rgba8> resampled_picture(const Camera& to, const Camera& from, ConstImageView<Rgba8> picture) {
    Image<Rgba8> result(to.width, to.height);
    const glm::dmat3 from_from_to = pixel_in_to_from_pixel_in_from(from, to);
    for (int y = 0; y < to.height; ++y) {
        for (int x = 0; x < to.width; ++x) {
            const glm::dvec3 p = from_from_to * glm::dvec3(x + 0.5, y + 0.5, 1);
            const glm::dvec3 ray = to.ray(x + 0.5, y + 0.5);
            if (glm::dot(ray, from.forward()) <= 0) continue;
            const double px = p.x / p.z;
            const double py = p.y / p.z;
            if (px < -1 || py < -1 || px > picture.width() + 1 || py > picture.height() + 1) continue;
            result(x, y) = straight(sample(picture, px, py));
        }
    }
    return result;
}

}  // namespace rs::encode
