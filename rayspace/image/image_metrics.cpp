#include "rayspace/image/image_metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rs {
namespace {

constexpr int kWindowRadius = 5;

int premultiplied(int colour, int alpha) {
    return (colour * alpha + 127) / 255;
}

int channel(const Rgba8& p, int c) {
    return premultiplied(c == 0 ? p.r : c == 1 ? p.g : p.b, p.a);
}

std::array<double, 2 * kWindowRadius + 1> gaussian_window() {
    std::array<double, 2 * kWindowRadius + 1> window{};
    for (int i = -kWindowRadius; i <= kWindowRadius; ++i) {
        window[static_cast<std::size_t>(i + kWindowRadius)] = std::exp(-i * i / (2 * 1.5 * 1.5));
    }
    return window;
}

// Separable Gaussian, clipped at the edges and renormalised there.
Image<float> gaussian_blur(const Image<float>& source) {
    static const auto kWindow = gaussian_window();
    Image<float> across(source.width(), source.height());
    Image<float> result(source.width(), source.height());
    const auto pass = [](int length, int at, auto sample) {
        double sum = 0, weight = 0;
        for (int i = std::max(-kWindowRadius, -at); i <= std::min(kWindowRadius, length - 1 - at); ++i) {
            const double w = kWindow[static_cast<std::size_t>(i + kWindowRadius)];
            sum += w * sample(at + i);
            weight += w;
        }
        return static_cast<float>(sum / weight);
    };
    for (int y = 0; y < source.height(); ++y) {
        for (int x = 0; x < source.width(); ++x) {
            across(x, y) = pass(source.width(), x, [&](int i) { return double{source(i, y)}; });
        }
    }
    for (int y = 0; y < source.height(); ++y) {
        for (int x = 0; x < source.width(); ++x) {
            result(x, y) = pass(source.height(), y, [&](int i) { return double{across(x, i)}; });
        }
    }
    return result;
}

double mean_ssim(ConstImageView<Rgba8> a, ConstImageView<Rgba8> b, std::int64_t object_pixels) {
    constexpr double kC1 = (0.01 * 255) * (0.01 * 255);
    constexpr double kC2 = (0.03 * 255) * (0.03 * 255);
    const int width = a.width();
    const int height = a.height();
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
        Image<float> pa(width, height), pb(width, height), paa(width, height), pbb(width, height), pab(width, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const float va = static_cast<float>(channel(a(x, y), c));
                const float vb = static_cast<float>(channel(b(x, y), c));
                pa(x, y) = va;
                pb(x, y) = vb;
                paa(x, y) = va * va;
                pbb(x, y) = vb * vb;
                pab(x, y) = va * vb;
            }
        }
        const Image<float> ma = gaussian_blur(pa), mb = gaussian_blur(pb), maa = gaussian_blur(paa),
                           mbb = gaussian_blur(pbb), mab = gaussian_blur(pab);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                if (a(x, y).a == 0 && b(x, y).a == 0) continue;
                const double ua = ma(x, y), ub = mb(x, y);
                const double variance_a = maa(x, y) - ua * ua;
                const double variance_b = mbb(x, y) - ub * ub;
                const double covariance = mab(x, y) - ua * ub;
                sum += (2 * ua * ub + kC1) * (2 * covariance + kC2) /
                       ((ua * ua + ub * ub + kC1) * (variance_a + variance_b + kC2));
            }
        }
    }
    return object_pixels == 0 ? 1.0 : sum / (3.0 * static_cast<double>(object_pixels));
}

}  // namespace

double ImageDifference::psnr_db() const {
    if (object_pixels == 0 || squared_error == 0) return 99;
    return std::min(99.0, 10 * std::log10(255.0 * 255.0 * 3.0 * static_cast<double>(object_pixels) / squared_error));
}

ImageDifference compare_images_psnr(ConstImageView<Rgba8> a, ConstImageView<Rgba8> b) {
    RS_CHECK(a.width() == b.width() && a.height() == b.height());
    ImageDifference difference;
    std::int64_t squared = 0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            const Rgba8 pa = a(x, y);
            const Rgba8 pb = b(x, y);
            if (pa.a == 0 && pb.a == 0) continue;
            ++difference.object_pixels;
            for (int c = 0; c < 3; ++c) {
                const int d = channel(pa, c) - channel(pb, c);
                squared += d * d;
            }
        }
    }
    difference.squared_error = static_cast<double>(squared);
    return difference;
}

ImageDifference compare_images(ConstImageView<Rgba8> a, ConstImageView<Rgba8> b) {
    ImageDifference difference = compare_images_psnr(a, b);
    difference.ssim = mean_ssim(a, b, difference.object_pixels);
    return difference;
}

DifferenceSummary summarise(std::span<const ImageDifference> differences) {
    DifferenceSummary summary;
    ImageDifference pooled;
    for (const ImageDifference& difference : differences) {
        summary.mean_psnr_db += difference.psnr_db() / static_cast<double>(differences.size());
        summary.mean_ssim += difference.ssim / static_cast<double>(differences.size());
        pooled.object_pixels += difference.object_pixels;
        pooled.squared_error += difference.squared_error;
    }
    summary.pooled_psnr_db = pooled.psnr_db();
    return summary;
}

}  // namespace rs
