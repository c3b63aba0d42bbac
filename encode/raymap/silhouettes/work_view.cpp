#include "encode/raymap/silhouettes/work_view.hpp"

#include "encode/set/soft_coverage.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace rs::encode {
namespace {

// Mean colour weighted by alpha, and mean alpha.
Rgba8 block_mean(ConstImageView<Rgba8> image, int x0, int y0, int side) {
    int r = 0, g = 0, b = 0, a = 0;
    for (int y = y0; y < y0 + side; ++y) {
        for (int x = x0; x < x0 + side; ++x) {
            const Rgba8 pixel = image(x, y);
            r += pixel.r * pixel.a;
            g += pixel.g * pixel.a;
            b += pixel.b * pixel.a;
            a += pixel.a;
        }
    }
    if (a == 0) return {};
    const auto mean = [](int sum, int weight) { return static_cast<std::uint8_t>((sum + weight / 2) / weight); };
    return {mean(r, a), mean(g, a), mean(b, a), mean(a, side * side)};
}

}  // namespace

HorizontalRay WorkView::ray_of(double column) const {
    HorizontalRay ray;
    const glm::dvec2 direction = forward + right * ((column - cx) / fl_x);
    ray.horizontal_per_axial = glm::length(direction);
    ray.along = direction / ray.horizontal_per_axial;
    ray.to_foot = -glm::dot(centre, ray.along);
    ray.foot = centre + ray.to_foot * ray.along;
    return ray;
}

WorkView make_work_view(const Camera& camera, ConstImageView<Rgba8> image, int reduction) {
    WorkView view;
    view.width = image.width() / reduction;
    view.height = image.height() / reduction;
    view.fl_x = camera.fl_x / reduction;
    view.fl_y = camera.fl_y / reduction;
    view.cx = camera.cx / reduction;
    view.cy = camera.cy / reduction;
    view.centre = {camera.centre().x, camera.centre().z};
    view.centre_y = camera.centre().y;
    view.right = {camera.right().x, camera.right().z};
    view.forward = {camera.forward().x, camera.forward().z};
    view.columns = Image<Rgba8>(view.height, view.width);
    for (int column = 0; column < view.width; ++column) {
        for (int row = 0; row < view.height; ++row) {
            view.columns(row, column) = block_mean(image, column * reduction, row * reduction, reduction);
        }
    }
    return view;
}

WorkView halve(const WorkView& view) {
    WorkView half = view;
    half.width = view.width / 2;
    half.height = view.height / 2;
    for (double* const number : {&half.fl_x, &half.fl_y, &half.cx, &half.cy}) *number /= 2;
    half.columns = Image<Rgba8>(half.height, half.width);
    for (int column = 0; column < half.width; ++column) {
        for (int row = 0; row < half.height; ++row) {
            half.columns(row, column) = block_mean(view.columns.view(), 2 * row, 2 * column, 2);
        }
    }
    return half;
}

Image<std::uint8_t> soft_pixels(const WorkView& view) {
    constexpr int kRadius_px = 2;
    Image<std::uint8_t> alpha(view.columns.width(), view.columns.height());
    std::ranges::transform(view.columns.pixels(), alpha.pixels().begin(), &Rgba8::a);
    Image<std::uint8_t> soft = find_soft_patches(alpha, kRadius_px);
    std::ranges::transform(soft.pixels(), alpha.pixels(), soft.pixels().begin(),
                           [](std::uint8_t patch, int a) { return a < kInside ? patch : std::uint8_t{0}; });
    return soft;
}

void make_soft_opaque(WorkView& view, const Image<std::uint8_t>& soft) {
    const auto before_white = [](int value, int alpha) {
        return static_cast<std::uint8_t>((value * alpha + 255 * (255 - alpha) + 127) / 255);
    };
    for (std::size_t n = 0; n < soft.pixels().size(); ++n) {
        if (soft.pixels()[n] == 0) continue;
        Rgba8& pixel = view.columns.pixels()[n];
        pixel = {before_white(pixel.r, pixel.a), before_white(pixel.g, pixel.a), before_white(pixel.b, pixel.a), 255};
    }
}

Image<std::uint8_t> measure_texture(const WorkView& view) {
    constexpr int kRadius_px = 4;
    const int width = view.columns.width();
    const int height = view.columns.height();
    // Summed-area tables over the object's pixels. They may wrap around, but sums over 9x9 pixels fit.
    struct Sums {
        std::uint32_t luma = 0, squares = 0, count = 0;
    };
    Image<Sums> sums(width + 1, height + 1, Sums{});
    for (int y = 0; y < height; ++y) {
        Sums row;
        for (int x = 0; x < width; ++x) {
            const Rgba8 c = view.columns(x, y);
            if (c.a >= kInside) {
                const std::uint32_t luma = (77U * c.r + 150U * c.g + 29U * c.b + 128U) >> 8U;
                row.luma += luma;
                row.squares += luma * luma;
                ++row.count;
            }
            const Sums& above = sums(x + 1, y);
            sums(x + 1, y + 1) = {above.luma + row.luma, above.squares + row.squares, above.count + row.count};
        }
    }
    Image<std::uint8_t> texture(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (view.columns(x, y).a < kInside) continue;
            const int left = std::max(x - kRadius_px, 0);
            const int top = std::max(y - kRadius_px, 0);
            const int right = std::min(x + kRadius_px + 1, width);
            const int bottom = std::min(y + kRadius_px + 1, height);
            const auto around = [&](std::uint32_t Sums::*sum) {
                return static_cast<float>(sums(right, bottom).*sum - sums(left, bottom).*sum - sums(right, top).*sum +
                                          sums(left, top).*sum);
            };
            const float count = around(&Sums::count);
            const float mean = around(&Sums::luma) / count;
            const float variance = around(&Sums::squares) / count - mean * mean;
            texture(x, y) = static_cast<std::uint8_t>(std::sqrt(std::max(variance, 0.0F)));
        }
    }
    return texture;
}

void attenuate_shading(WorkView& view) {
    constexpr int kRadius_px = 4;
    constexpr int kGrey = 128;
    constexpr int kReduction = 4;  // of the mean's distance from grey
    const int width = view.columns.width();
    const int height = view.columns.height();
    // Summed-area tables of red, green and blue times alpha, and of alpha. They may wrap around, but sums over 9x9
    // pixels fit.
    using Sums = std::array<std::uint32_t, 4>;
    Image<Sums> sums(width + 1, height + 1, Sums{});
    for (int y = 0; y < height; ++y) {
        Sums row{};
        for (int x = 0; x < width; ++x) {
            const Rgba8 c = view.columns(x, y);
            const std::array<int, 4> weighted = {c.r * c.a, c.g * c.a, c.b * c.a, c.a};
            for (std::size_t k = 0; k < row.size(); ++k) {
                row[k] += static_cast<std::uint32_t>(weighted[k]);
                sums(x + 1, y + 1)[k] = sums(x + 1, y)[k] + row[k];
            }
        }
    }
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            Rgba8& pixel = view.columns(x, y);
            if (pixel.a == 0) continue;
            const int left = std::max(x - kRadius_px, 0);
            const int top = std::max(y - kRadius_px, 0);
            const int right = std::min(x + kRadius_px + 1, width);
            const int bottom = std::min(y + kRadius_px + 1, height);
            const auto around = [&](std::size_t k) -> int {
                return static_cast<int>(sums(right, bottom)[k] - sums(left, bottom)[k] - sums(right, top)[k] +
                                        sums(left, top)[k]);
            };
            const int weight = around(3);  // > 0, since it includes this pixel's alpha
            const auto weakened = [&](std::uint8_t value, std::size_t k) {
                const int mean = (around(k) + weight / 2) / weight;
                const int result = value - mean + kGrey + (mean - kGrey) / kReduction;
                return static_cast<std::uint8_t>(std::clamp(result, 0, 255));
            };
            pixel = {weakened(pixel.r, 0), weakened(pixel.g, 1), weakened(pixel.b, 2), pixel.a};
        }
    }
}

}  // namespace rs::encode
