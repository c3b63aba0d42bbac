#include "capture/photos/intake/reduction.hpp"

#include "rayspace/base/check.hpp"
#include "rayspace/image/linear_light.hpp"
#include "rayspace/image/srgb_codes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::capture {
namespace {

// The input pixels [begin, end) that one output pixel covers, which spans [from, to) of the input.
struct Cover {
    int begin, end;
    double from, to;
    // Share of the output pixel that input pixel i makes up.
    [[nodiscard]] float weight(int i) const {
        return static_cast<float>((std::min(to, i + 1.0) - std::max(from, static_cast<double>(i))) / (to - from));
    }
};

Cover cover(double from, double to, int length) {
    return {static_cast<int>(from), std::min(length, static_cast<int>(std::ceil(to))), from, to};
}

// `count` output pixels side by side over `length` input pixels.
std::vector<Cover> covers(int count, int length) {
    std::vector<Cover> result;
    for (int i = 0; i < count; ++i) {
        result.push_back(
            cover(static_cast<double>(i) * length / count, static_cast<double>(i + 1) * length / count, length));
    }
    return result;
}

// `count` output pixels of `step` input pixels each, in the middle of `length`.
std::vector<Cover> covers_in_the_middle(int count, double step, int length) {
    const double first = 0.5 * (length - count * step);
    std::vector<Cover> result;
    for (int i = 0; i < count; ++i) {
        result.push_back(cover(std::max(0.0, first + i * step), first + (i + 1) * step, length));
    }
    return result;
}

// What is averaged: codes as they are, or light.
struct OfCodes {
    static float value(std::uint8_t code) { return static_cast<float>(code); }
    static std::uint8_t code(float value) { return static_cast<std::uint8_t>(std::min(255.0F, value + 0.5F)); }
};
struct OfLight {
    static float value(std::uint8_t code) { return linear_from_srgb8(code); }
    static std::uint8_t code(float value) { return srgb8_by_table(value); }
};

// Adds `weight` times a row of the input, colours premultiplied, to the sums of a row of the output.
template <class Of>
void add_row(std::span<const Rgba8> row, const std::vector<Cover>& columns, float weight, std::vector<RgbaF>& sums) {
    for (std::size_t x = 0; x < columns.size(); ++x) {
        const Cover& over = columns[x];
        RgbaF& sum = sums[x];
        for (int u = over.begin; u < over.end; ++u) {
            const Rgba8& p = row[static_cast<std::size_t>(u)];
            const float a = weight * over.weight(u) * static_cast<float>(p.a) / 255;
            sum.r += a * Of::value(p.r);
            sum.g += a * Of::value(p.g);
            sum.b += a * Of::value(p.b);
            sum.a += a;
        }
    }
}

template <class Of>
Rgba8 mean_colour(const RgbaF& sum) {
    const float inverse = sum.a > 0 ? 1 / sum.a : 0;
    return {Of::code(sum.r * inverse), Of::code(sum.g * inverse), Of::code(sum.b * inverse),
            OfCodes::code(sum.a * 255)};
}

template <class Of>
Image<Rgba8> averaged_over(ConstImageView<Rgba8> picture, const std::vector<Cover>& columns,
                           const std::vector<Cover>& rows) {
    Image<Rgba8> result(static_cast<int>(columns.size()), static_cast<int>(rows.size()));
    std::vector<RgbaF> sums;  // of one row of the result: colours times alpha, and alpha
    for (int y = 0; y < result.height(); ++y) {
        const Cover& over = rows[static_cast<std::size_t>(y)];
        sums.assign(columns.size(), {});
        for (int v = over.begin; v < over.end; ++v) {
            add_row<Of>(picture.row_span(v), columns, over.weight(v), sums);
        }
        std::transform(sums.begin(), sums.end(), result.row(y), mean_colour<Of>);
    }
    return result;
}

}  // namespace

Image<Rgba8> reduced(ConstImageView<Rgba8> picture, int side_px) {
    const int longest = std::max(picture.width(), picture.height());
    if (longest <= side_px) {
        Image<Rgba8> copy(picture.width(), picture.height());
        for (int y = 0; y < picture.height(); ++y) std::copy_n(picture.row(y), picture.width(), copy.row(y));
        return copy;
    }
    const double scale = static_cast<double>(side_px) / longest;
    const int width = std::max(1, static_cast<int>(std::lround(picture.width() * scale)));
    const int height = std::max(1, static_cast<int>(std::lround(picture.height() * scale)));
    return averaged_over<OfCodes>(picture, covers(width, picture.width()), covers(height, picture.height()));
}

Image<Rgba8> averaged_light(ConstImageView<Rgba8> picture, int width, int height, double step) {
    RS_CHECK(step >= 1 && width * step < picture.width() + 1e-6 && height * step < picture.height() + 1e-6);
    return averaged_over<OfLight>(picture, covers_in_the_middle(width, step, picture.width()),
                                  covers_in_the_middle(height, step, picture.height()));
}

}  // namespace rs::capture
