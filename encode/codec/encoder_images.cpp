#include "encode/codec/encoder_images.hpp"

#include "rayspace/codec/prediction_unit.hpp"
#include "rayspace/object/yuv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace rs::encode {
namespace {

std::uint8_t rounded(double value) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
}

int coded_size(int size) {
    return (size + codec::kMacroblock - 1) / codec::kMacroblock * codec::kMacroblock;
}

}  // namespace

SourceImage source_image(ConstImageView<Rgba8> image, int alpha_bits) {
    const int width = coded_size(image.width());
    const int height = coded_size(image.height());
    SourceImage source;
    for (auto& plane : source.planes) plane = Image<std::uint8_t>(width, height, 128);
    source.coverage = Image<std::uint8_t>(width, height);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const Rgba8 p = image(x, y);
            source.coverage(x, y) = p.a;
            if (p.a == 0) continue;
            const double luma = 0.299 * p.r + 0.587 * p.g + 0.114 * p.b;
            source.planes[0](x, y) = rounded(luma);
            source.planes[1](x, y) = rounded(128 + (p.b - luma) / 1.772);
            source.planes[2](x, y) = rounded(128 + (p.r - luma) / 1.402);
        }
    }
    set_alpha_bits(source, alpha_bits);
    return source;
}

void set_alpha_bits(SourceImage& source, int alpha_bits) {
    const int width = source.coverage.width();
    const int height = source.coverage.height();
    source.alpha = Image<std::uint8_t>(width, height);
    source.valid = Image<std::uint8_t>(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int level = codec::level_of_alpha(source.coverage(x, y), alpha_bits);
            source.alpha(x, y) = static_cast<std::uint8_t>(level);
            source.valid(x, y) = level != 0 ? 255 : 0;
        }
    }
}

codec::EdgeAlpha estimate_edge_alpha(const std::vector<SourceImage>& sources) {
    std::array<std::int64_t, 24> sum{};
    std::array<std::int64_t, 24> count{};
    for (const SourceImage& source : sources) {
        const Image<std::uint8_t>& alpha = source.coverage;
        const auto mask = [&](int x, int y) { return alpha(x, y) >= 128 ? 1 : 0; };
        for (int y = 1; y + 1 < alpha.height(); ++y) {
            for (int x = 1; x + 1 < alpha.width(); ++x) {
                int weights = 0;
                for (int dy = -1; dy <= 1; ++dy) {
                    for (int dx = -1; dx <= 1; ++dx)
                        weights += (dx == 0 ? 2 : 1) * (dy == 0 ? 2 : 1) * mask(x + dx, y + dy);
                }
                const int own = mask(x, y);
                const int weight = own != 0 ? 16 - weights : weights;
                if (weight == 0) continue;
                const auto at = static_cast<std::size_t>(codec::kEdgeWeights * own + weight - 1);
                sum[at] += own != 0 ? 255 - alpha(x, y) : alpha(x, y);
                ++count[at];
            }
        }
    }
    codec::EdgeAlpha edge{};
    for (std::size_t i = 0; i < edge.size(); ++i) {
        if (count[i] == 0) continue;
        edge[i] =
            static_cast<std::uint8_t>(std::min<std::int64_t>((sum[i] + count[i] / 2) / count[i], codec::kMaxEdgeAlpha));
    }
    return edge;
}

CodedError measure_coded_error(const SourceImage& source, const codec::ConstPlaneViews& decoded, int width, int height,
                               int alpha_bits) {
    CodedError error;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (codec::alpha_of_level(source.alpha(x, y), alpha_bits) < 128) continue;
            const Rgba8 a = rgba_from_yuva(source.planes[0](x, y), source.planes[1](x, y), source.planes[2](x, y), 255);
            const Rgba8 b = rgba_from_yuva(decoded[0](x, y), decoded[1](x, y), decoded[2](x, y), 255);
            const auto square = [](int off) { return off * off; };
            error.squares += square(a.r - b.r) + square(a.g - b.g) + square(a.b - b.b);
            error.samples += 3;
        }
    }
    return error;
}

double coded_psnr_db(std::span<const CodedError> errors) {
    double squares = 0;
    double samples = 0;
    for (const CodedError& error : errors) {
        squares += static_cast<double>(error.squares);
        samples += static_cast<double>(error.samples);
    }
    return 10 * std::log10(255.0 * 255.0 * std::max(samples, 1.0) / std::max(squares, 1e-3));
}

}  // namespace rs::encode
