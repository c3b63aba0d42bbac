#include "encode/codec/source_picture.hpp"

#include "rayspace/codec/part_syntax.hpp"

#include <algorithm>
#include <cmath>

namespace rs::encode {
namespace {

std::uint8_t rounded(double value) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
}

int coded_size(int size) {
    return (size + codec::kMacroblock - 1) / codec::kMacroblock * codec::kMacroblock;
}

}  // namespace

SourcePicture source_picture(ConstImageView<Rgba8> picture, int alpha_bits) {
    const int width = coded_size(picture.width());
    const int height = coded_size(picture.height());
    SourcePicture source;
    for (auto& plane : source.planes) plane = Image<std::uint8_t>(width, height, 128);
    source.alpha = Image<std::uint8_t>(width, height);
    source.matters = Image<std::uint8_t>(width, height);
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            const Rgba8 p = picture(x, y);
            const int level = codec::level_of_alpha(p.a, alpha_bits);
            if (level == 0) continue;
            source.alpha(x, y) = static_cast<std::uint8_t>(level);
            source.matters(x, y) = 255;
            const double luma = 0.299 * p.r + 0.587 * p.g + 0.114 * p.b;
            source.planes[0](x, y) = rounded(luma);
            source.planes[1](x, y) = rounded(128 + (p.b - luma) / 1.772);
            source.planes[2](x, y) = rounded(128 + (p.r - luma) / 1.402);
        }
    }
    return source;
}

}  // namespace rs::encode
