#include "rayspace/image/premultiplied_sampling.hpp"

#include "rayspace/image/linear_light.hpp"
#include "rayspace/image/srgb_codes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rs {
namespace {

// Weights of the four samples around position t in 0..1 between the middle two.
std::array<float, 4> catmull_rom(float t) {
    return {((-0.5F * t + 1.0F) * t - 0.5F) * t, (1.5F * t - 2.5F) * t * t + 1.0F, ((-1.5F * t + 2.0F) * t + 0.5F) * t,
            (0.5F * t - 0.5F) * t * t};
}

RgbaF premultiplied(const Rgba8& p) {
    const float a = static_cast<float>(p.a) / 255.0F;
    return {linear_from_srgb8(p.r) * a, linear_from_srgb8(p.g) * a, linear_from_srgb8(p.b) * a, a};
}

Rgba8 straight(const RgbaF& p) {
    const auto alpha = static_cast<std::uint8_t>(std::lround(std::clamp(p.a, 0.0F, 1.0F) * 255.0F));
    if (alpha == 0) return {};
    // Divided by the alpha as it is: the kernel overshoots 1 just inside of an edge, and the colour with it.
    return {srgb8_by_table(p.r / p.a), srgb8_by_table(p.g / p.a), srgb8_by_table(p.b / p.a), alpha};
}

}  // namespace

Rgba8 sample_premultiplied(ConstImageView<Rgba8> picture, double x, double y) {
    const double left = std::floor(x - 0.5);
    const double top = std::floor(y - 0.5);
    const auto weight_x = catmull_rom(static_cast<float>(x - 0.5 - left));
    const auto weight_y = catmull_rom(static_cast<float>(y - 0.5 - top));
    RgbaF sum;
    for (int dy = 0; dy < 4; ++dy) {
        const int row = static_cast<int>(top) - 1 + dy;
        if (row < 0 || row >= picture.height()) continue;
        for (int dx = 0; dx < 4; ++dx) {
            const int column = static_cast<int>(left) - 1 + dx;
            if (column < 0 || column >= picture.width()) continue;
            const RgbaF p = premultiplied(picture(column, row));
            const float w = weight_x[static_cast<std::size_t>(dx)] * weight_y[static_cast<std::size_t>(dy)];
            sum.r += w * p.r;
            sum.g += w * p.g;
            sum.b += w * p.b;
            sum.a += w * p.a;
        }
    }
    return straight(sum);
}

PremultipliedPicture::PremultipliedPicture(ConstImageView<Rgba8> picture) {
    int left = picture.width(), right = 0, top = picture.height(), bottom = 0;
    for (int y = 0; y < picture.height(); ++y) {
        const std::span<const Rgba8> row = picture.row_span(y);
        const auto covered = [](const Rgba8& p) { return p.a != 0; };
        const auto first = std::find_if(row.begin(), row.end(), covered);
        if (first == row.end()) continue;
        const auto last = std::find_if(row.rbegin(), row.rend(), covered);
        left = std::min(left, static_cast<int>(first - row.begin()));
        right = std::max(right, static_cast<int>(row.rend() - last));
        top = std::min(top, y);
        bottom = y + 1;
    }
    if (left >= right) return;
    left_ = left;
    top_ = top;
    pixels_ = Image<RgbaF>(right - left, bottom - top);
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) pixels_(x - left, y - top) = premultiplied(picture(x, y));
    }
}

Rgba8 PremultipliedPicture::sample(double x, double y) const {
    const double left = std::floor(x - 0.5);
    const double top = std::floor(y - 0.5);
    const int column = static_cast<int>(left) - 1 - left_, row = static_cast<int>(top) - 1 - top_;
    if (column <= -4 || row <= -4 || column >= pixels_.width() || row >= pixels_.height()) return {};
    const auto weight_x = catmull_rom(static_cast<float>(x - 0.5 - left));
    const auto weight_y = catmull_rom(static_cast<float>(y - 0.5 - top));
    const int first = std::max(0, -column), behind = std::min(4, pixels_.width() - column);
    RgbaF sum;
    for (int dy = std::max(0, -row); dy < std::min(4, pixels_.height() - row); ++dy) {
        const RgbaF* const from = pixels_.row(row + dy);
        for (int dx = first; dx < behind; ++dx) {
            const RgbaF& p = from[column + dx];
            const float w = weight_x[static_cast<std::size_t>(dx)] * weight_y[static_cast<std::size_t>(dy)];
            sum.r += w * p.r;
            sum.g += w * p.g;
            sum.b += w * p.b;
            sum.a += w * p.a;
        }
    }
    return straight(sum);
}

}  // namespace rs
