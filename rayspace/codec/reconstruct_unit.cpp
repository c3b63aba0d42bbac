#include "rayspace/codec/reconstruct_unit.hpp"

#include "rayspace/codec/kernels/prediction.hpp"
#include "rayspace/codec/kernels/transform.hpp"

#include <algorithm>

namespace rs::codec {

int predict_alpha(const UnitChoice& choice, const std::array<ConstPlaneViews, 2>& references, int x, int y,
                  int alpha_bits) {
    if (!is_inter(choice.source)) return -1;
    const std::size_t r = uses(choice.source, 0) ? 0 : 1;
    const ConstImageView<std::uint8_t>& plane = references[r][3];
    const MotionVector motion = choice.motion[r];
    return level_of_alpha(plane(std::clamp(x + ((motion.x + 2) >> 2), 0, plane.width() - 1),
                                std::clamp(y + ((motion.y + 2) >> 2), 0, plane.height() - 1)),
                          alpha_bits);
}

void predict_unit(const UnitChoice& choice, const UnitPosition& place, int plane,
                  const std::array<ConstPlaneViews, 2>& references, ImageView<std::uint8_t> out) {
    std::uint8_t* const samples = out.row(place.y) + place.x;
    const auto p = static_cast<std::size_t>(plane);
    if (!is_inter(choice.source)) {
        predict_from_neighbours(samples, out.stride(), place.size, place.has_left, place.has_above, choice.intra_mode);
        return;
    }
    const std::size_t first = uses(choice.source, 0) ? 0 : 1;
    predict_from_image(references[first][p], place.x, place.y, choice.motion[first], place.size, samples, out.stride());
    if (choice.source != Source::kBoth) return;
    std::uint8_t other[kMacroblock * kMacroblock];
    predict_from_image(references[1][p], place.x, place.y, choice.motion[1], place.size, other, place.size);
    average_into(samples, out.stride(), other, place.size, place.size);
}

void add_residual(const Levels& levels, int step, int size, std::uint8_t* samples, std::ptrdiff_t stride) {
    std::int16_t coefficients[kLargestTransform * kLargestTransform];
    std::int16_t residual[kLargestTransform * kLargestTransform];
    std::fill_n(coefficients, size * size, std::int16_t{0});
    for (int v = 0; v < levels.used; ++v) {
        for (int u = 0; u < levels.used; ++u) {
            const int level = levels.at[v * Levels::kStride + u];
            if (level != 0) coefficients[v * size + u] = dequantise(level, step, size);
        }
    }
    inverse_transform(coefficients, size, std::max(levels.used, 1), residual);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            std::uint8_t& sample = samples[y * stride + x];
            sample = static_cast<std::uint8_t>(std::clamp(sample + residual[y * size + x], 0, 255));
        }
    }
}

void reconstruct_unit(const UnitChoice& choice, const UnitPosition& place, int step, const DenseCode& code,
                      const std::array<ConstPlaneViews, 2>& references, const PlaneViews& out) {
    const int size = choice.transform_size(place.size);
    for (int plane = 0; plane < kPlanes; ++plane) {
        const auto p = static_cast<std::size_t>(plane);
        predict_unit(choice, place, plane, references, out[p]);
        if (!choice.coded) continue;
        for (int t = 0; t < choice.transforms(place.size); ++t) {
            if (!choice.plane_coded[p][static_cast<std::size_t>(t)]) continue;
            add_residual(choice.levels[p][static_cast<std::size_t>(t)], code.plane_step(step, plane), size,
                         out[p].row(place.y + (t >> 1) * kBlock) + place.x + (t & 1) * kBlock, out[p].stride());
        }
    }
}

}  // namespace rs::codec
