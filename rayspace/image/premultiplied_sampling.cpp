#include "rayspace/image/premultiplied_sampling.hpp"

#include "rayspace/image/linear_light.hpp"

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
    // Divide by the unclamped alpha: the kernel overshoots 1 just inside of an edge, and the colour with it.
    return {srgb8_by_table(p.r / p.a), srgb8_by_table(p.g / p.a), srgb8_by_table(p.b / p.a), alpha};
}

// The filtered sum, which may overshoot.
RgbaF filtered(ConstImageView<Rgba8> image, double x, double y) {
    const double left = std::floor(x - 0.5);
    const double top = std::floor(y - 0.5);
    const auto weight_x = catmull_rom(static_cast<float>(x - 0.5 - left));
    const auto weight_y = catmull_rom(static_cast<float>(y - 0.5 - top));
    const int column = static_cast<int>(left) - 1, row = static_cast<int>(top) - 1;
    const int first = std::max(0, -column), behind = std::min(4, image.width() - column);
    RgbaF sum;
    for (int dy = std::max(0, -row); dy < std::min(4, image.height() - row); ++dy) {
        for (int dx = first; dx < behind; ++dx) {
            const Rgba8& code = image(column + dx, row + dy);
            if (code.a == 0) continue;
            const RgbaF p = premultiplied(code);
            const float w = weight_x[static_cast<std::size_t>(dx)] * weight_y[static_cast<std::size_t>(dy)];
            sum.r += w * p.r;
            sum.g += w * p.g;
            sum.b += w * p.b;
            sum.a += w * p.a;
        }
    }
    return sum;
}

}  // namespace

Rgba8 sample_premultiplied(ConstImageView<Rgba8> image, double x, double y) {
    return straight(filtered(image, x, y));
}

RgbaF sample_linear(ConstImageView<Rgba8> image, double x, double y) {
    const RgbaF sum = filtered(image, x, y);
    if (sum.a <= 0) return {};
    const float alpha = std::min(sum.a, 1.0F);
    const auto limited = [&](float value) { return std::clamp(value / sum.a, 0.0F, 1.0F) * alpha; };
    return {limited(sum.r), limited(sum.g), limited(sum.b), alpha};
}

PremultipliedImage::PremultipliedImage(ConstImageView<Rgba8> image) {
    int left = image.width(), right = 0, top = image.height(), bottom = 0;
    std::vector<Columns> covered;
    for (int y = 0; y < image.height(); ++y) {
        const std::span<const Rgba8> row = image.row_span(y);
        const auto is_covered = [](const Rgba8& p) { return p.a != 0; };
        const auto first = std::find_if(row.begin(), row.end(), is_covered);
        covered.emplace_back();
        if (first == row.end()) continue;
        const auto last = std::find_if(row.rbegin(), row.rend(), is_covered);
        covered.back() = {static_cast<int>(first - row.begin()), static_cast<int>(row.rend() - last)};
        left = std::min(left, covered.back().begin);
        right = std::max(right, covered.back().end);
        top = std::min(top, y);
        bottom = y + 1;
    }
    if (left >= right) return;
    left_ = left;
    top_ = top;
    pixels_ = Image<RgbaF>(right - left, bottom - top);
    for (int y = top; y < bottom; ++y) {
        const Columns& columns = covered_.emplace_back(covered[static_cast<std::size_t>(y)]);
        for (int x = columns.begin; x < columns.end; ++x) pixels_(x - left, y - top) = premultiplied(image(x, y));
    }
    for (Columns& columns : covered_) columns = {columns.begin - left, columns.end - left};
}

Rgba8 PremultipliedImage::sample(double x, double y) const {
    const double left = std::floor(x - 0.5);
    const double top = std::floor(y - 0.5);
    const int column = static_cast<int>(left) - 1 - left_, row = static_cast<int>(top) - 1 - top_;
    if (column <= -4 || row <= -4 || column >= pixels_.width() || row >= pixels_.height()) return {};
    int first_row = std::max(0, -row), behind_row = std::min(4, pixels_.height() - row);
    const auto is_bare = [&](int dy) {
        const Columns& columns = covered_[static_cast<std::size_t>(row + dy)];
        return column + 4 <= columns.begin || column >= columns.end;
    };
    while (first_row < behind_row && is_bare(first_row)) ++first_row;
    while (first_row < behind_row && is_bare(behind_row - 1)) --behind_row;
    if (first_row == behind_row) return {};
    const auto weight_x = catmull_rom(static_cast<float>(x - 0.5 - left));
    const auto weight_y = catmull_rom(static_cast<float>(y - 0.5 - top));
    const int first = std::max(0, -column), behind = std::min(4, pixels_.width() - column);
    RgbaF sum;
    for (int dy = first_row; dy < behind_row; ++dy) {
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
