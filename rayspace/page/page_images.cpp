#include "rayspace/page/page_images.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace rs {
namespace {

// Weights of an area average along an axis: output n is the mean of the input over [n * scale, (n + 1) * scale).
struct Coverage {
    int first = 0;
    std::vector<float> weights;  // sum 1
};

std::vector<Coverage> coverage(int from, int to) {
    const double scale = static_cast<double>(from) / to;
    std::vector<Coverage> all(static_cast<std::size_t>(to));
    for (int n = 0; n < to; ++n) {
        const double begin = n * scale;
        const double end = std::min<double>(begin + scale, from);
        Coverage& one = all[static_cast<std::size_t>(n)];
        one.first = static_cast<int>(begin);
        for (int i = one.first; i < end; ++i) {
            const double share = std::min(end, i + 1.0) - std::max(begin, static_cast<double>(i));
            one.weights.push_back(static_cast<float>(share / (end - begin)));
        }
    }
    return all;
}

Rgba8 averaged(ConstImageView<Rgba8> image, const Coverage& across, const Coverage& down) {
    float r = 0, g = 0, b = 0, a = 0;
    for (std::size_t j = 0; j < down.weights.size(); ++j) {
        const Rgba8* const row = image.row(down.first + static_cast<int>(j)) + across.first;
        for (std::size_t i = 0; i < across.weights.size(); ++i) {
            const float weight = down.weights[j] * across.weights[i] * static_cast<float>(row[i].a);
            r += weight * linear_from_srgb8(row[i].r);
            g += weight * linear_from_srgb8(row[i].g);
            b += weight * linear_from_srgb8(row[i].b);
            a += weight;
        }
    }
    const auto alpha = static_cast<std::uint8_t>(std::lround(std::min(a, 255.0F)));
    if (alpha == 0) return {};
    return {srgb8_from_linear(r / a), srgb8_from_linear(g / a), srgb8_from_linear(b / a), alpha};
}

float unit(float value) {
    return value > 0 ? std::min(value, 1.0F) : 0.0F;  // NaN compares false
}

std::uint8_t byte_of(float value) {
    return static_cast<std::uint8_t>(std::lround(unit(value) * 255));
}

}  // namespace

Image<Rgba8> downscale(ConstImageView<Rgba8> image, int longest_side_px) {
    RS_CHECK(longest_side_px >= 1);
    const int longest = std::max(image.width(), image.height());
    const double scale = longest > longest_side_px ? static_cast<double>(longest_side_px) / longest : 1.0;
    const auto side = [&](int px) { return px == 0 ? 0 : std::max(1, static_cast<int>(std::lround(px * scale))); };
    Image<Rgba8> small(side(image.width()), side(image.height()));
    if (scale == 1.0) {
        for (int y = 0; y < small.height(); ++y) std::copy_n(image.row(y), small.width(), small.row(y));
        return small;
    }
    const std::vector<Coverage> across = coverage(image.width(), small.width());
    const std::vector<Coverage> down = coverage(image.height(), small.height());
    for (int y = 0; y < small.height(); ++y) {
        for (int x = 0; x < small.width(); ++x) {
            small(x, y) = averaged(image, across[static_cast<std::size_t>(x)], down[static_cast<std::size_t>(y)]);
        }
    }
    return small;
}

// The polynomial of the Turbo colour map (Mikhailov 2019).
Rgba8 depth_colour(float value) {
    using Polynomial = std::array<float, 6>;
    constexpr Polynomial kRed{0.13572138F, 4.61539260F, -42.66032258F, 132.13108234F, -152.94239396F, 59.28637943F};
    constexpr Polynomial kGreen{0.09140261F, 2.19418839F, 4.84296658F, -14.18503333F, 4.27729857F, 2.82956604F};
    constexpr Polynomial kBlue{0.10667330F, 12.64194608F, -60.58204836F, 110.36276771F, -89.90310912F, 27.34824973F};
    const float x = unit(value);
    const auto at = [x](const Polynomial& c) {
        return byte_of(c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5])))));
    };
    return {at(kRed), at(kGreen), at(kBlue), 255};
}

Rgba8 heat_colour(float value) {
    const float x = 3 * unit(value);
    return {byte_of(x), byte_of(x - 1), byte_of(x - 2), 255};
}

Image<Rgba8> depth_image(ConstImageView<float> depth, float low, float high) {
    RS_CHECK(low < high);
    Image<Rgba8> image(depth.width(), depth.height());
    for (int y = 0; y < depth.height(); ++y) {
        for (int x = 0; x < depth.width(); ++x) {
            if (std::isfinite(depth(x, y))) image(x, y) = depth_colour((depth(x, y) - low) / (high - low));
        }
    }
    return image;
}

Image<Rgba8> error_image(ConstImageView<Rgba8> a, ConstImageView<Rgba8> b, int full_scale) {
    RS_CHECK(a.width() == b.width() && a.height() == b.height() && full_scale >= 1 && full_scale <= 255);
    constexpr Rgba8 kBlack{0, 0, 0, 255};
    Image<Rgba8> image(a.width(), a.height());
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            if (a(x, y).a == 0 && b(x, y).a == 0) continue;
            const Rgba8 p = over(a(x, y), kBlack);
            const Rgba8 q = over(b(x, y), kBlack);
            const int worst = std::max({std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)});
            image(x, y) = heat_colour(static_cast<float>(worst) / static_cast<float>(full_scale));
        }
    }
    return image;
}

std::vector<int> select_evenly(int count, int wanted) {
    const int taken = std::min(count, wanted);
    std::vector<int> numbers;
    numbers.reserve(static_cast<std::size_t>(std::max(taken, 0)));
    for (int n = 0; n < taken; ++n) {
        numbers.push_back(static_cast<int>(static_cast<std::int64_t>(n) * count / taken));
    }
    return numbers;
}

}  // namespace rs
