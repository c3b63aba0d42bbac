#include "capture/photos/intake/reduction.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::capture {
namespace {

// Interval [from, to) of the input that one output pixel covers, and the input pixels [begin, end) that it overlaps.
struct Footprint {
    int begin, end;
    double from, to;
    // Weight of input pixel i in the output pixel; the weights add up to 1.
    [[nodiscard]] float weight(int i) const {
        return static_cast<float>((std::min(to, i + 1.0) - std::max(from, static_cast<double>(i))) / (to - from));
    }
};

Footprint footprint(double from, double to, int length) {
    return {static_cast<int>(from), std::min(length, static_cast<int>(std::ceil(to))), from, to};
}

// Footprints of `count` output pixels that divide `length` input pixels evenly.
std::vector<Footprint> footprints(int count, int length) {
    std::vector<Footprint> result;
    for (int i = 0; i < count; ++i) {
        result.push_back(
            footprint(static_cast<double>(i) * length / count, static_cast<double>(i + 1) * length / count, length));
    }
    return result;
}

// Footprints of `count` output pixels of `step` input pixels each, centred in `length`.
std::vector<Footprint> centred_footprints(int count, double step, int length) {
    const double first = 0.5 * (length - count * step);
    std::vector<Footprint> result;
    for (int i = 0; i < count; ++i) {
        result.push_back(footprint(std::max(0.0, first + i * step), first + (i + 1) * step, length));
    }
    return result;
}

// Domains of averaging: sRGB codes or linear light.
struct CodeDomain {
    static float value(std::uint8_t code) { return static_cast<float>(code); }
    static std::uint8_t code(float value) { return static_cast<std::uint8_t>(std::min(255.0F, value + 0.5F)); }
};
struct LinearDomain {
    static float value(std::uint8_t code) { return linear_from_srgb8(code); }
    static std::uint8_t code(float value) { return srgb8_by_table(value); }
};

// Adds `weight` times a row of the input, premultiplied by alpha, to the sums of an output row.
template <class Domain>
void add_row(std::span<const Rgba8> row, const std::vector<Footprint>& columns, float weight,
             std::vector<RgbaF>& sums) {
    for (std::size_t x = 0; x < columns.size(); ++x) {
        const Footprint& footprint = columns[x];
        RgbaF& sum = sums[x];
        for (int u = footprint.begin; u < footprint.end; ++u) {
            const Rgba8& p = row[static_cast<std::size_t>(u)];
            const float a = weight * footprint.weight(u) * static_cast<float>(p.a) / 255;
            sum.r += a * Domain::value(p.r);
            sum.g += a * Domain::value(p.g);
            sum.b += a * Domain::value(p.b);
            sum.a += a;
        }
    }
}

template <class Domain>
Rgba8 mean_colour(const RgbaF& sum) {
    const float inverse = sum.a > 0 ? 1 / sum.a : 0;
    return {Domain::code(sum.r * inverse), Domain::code(sum.g * inverse), Domain::code(sum.b * inverse),
            CodeDomain::code(sum.a * 255)};
}

template <class Domain>
Image<Rgba8> area_average(ConstImageView<Rgba8> image, const std::vector<Footprint>& columns,
                          const std::vector<Footprint>& rows) {
    Image<Rgba8> result(static_cast<int>(columns.size()), static_cast<int>(rows.size()));
    std::vector<RgbaF> sums;  // one output row, premultiplied
    for (int y = 0; y < result.height(); ++y) {
        const Footprint& footprint = rows[static_cast<std::size_t>(y)];
        sums.assign(columns.size(), {});
        for (int v = footprint.begin; v < footprint.end; ++v) {
            add_row<Domain>(image.row_span(v), columns, footprint.weight(v), sums);
        }
        std::transform(sums.begin(), sums.end(), result.row(y), mean_colour<Domain>);
    }
    return result;
}

}  // namespace

Image<Rgba8> reduced(ConstImageView<Rgba8> image, int max_side_px) {
    const int longest = std::max(image.width(), image.height());
    if (longest <= max_side_px) {
        Image<Rgba8> copy(image.width(), image.height());
        for (int y = 0; y < image.height(); ++y) std::copy_n(image.row(y), image.width(), copy.row(y));
        return copy;
    }
    const double scale = static_cast<double>(max_side_px) / longest;
    const int width = std::max(1, static_cast<int>(std::lround(image.width() * scale)));
    const int height = std::max(1, static_cast<int>(std::lround(image.height() * scale)));
    return area_average<CodeDomain>(image, footprints(width, image.width()), footprints(height, image.height()));
}

Image<Rgba8> reduced_in_linear_light(ConstImageView<Rgba8> image, int width, int height, double step) {
    RS_CHECK(step >= 1 && width * step < image.width() + 1e-6 && height * step < image.height() + 1e-6);
    return area_average<LinearDomain>(image, centred_footprints(width, step, image.width()),
                                      centred_footprints(height, step, image.height()));
}

}  // namespace rs::capture
