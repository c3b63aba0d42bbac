#include "encode/codec/board/board_block.hpp"

#include <algorithm>

namespace rs::encode {
namespace {

constexpr std::size_t pixel_of(std::size_t quarter, std::size_t i) {
    return (quarter / 2 * 4 + i / 4) * 8 + quarter % 2 * 4 + i % 4;
}

// The 2x2 pixels of chroma sample `pair` of a whole block's vector.
constexpr std::array<std::size_t, 4> pixels_of_pair(std::size_t pair) {
    const std::size_t first = pair / 4 * 16 + pair % 4 * 2;
    return {first, first + 1, first + 8, first + 9};
}

template <class Prediction>
BlockResidual residual_of(const SourceImage& source, int x, int y, const Prediction& prediction) {
    BlockResidual residual;
    for (std::size_t i = 0; i < 64; ++i) {
        const int column = x + static_cast<int>(i % 8);
        const int row = y + static_cast<int>(i / 8);
        const bool valid = source.valid(column, row) != 0;
        residual.valid[i] = valid ? 1 : 0;
        for (std::size_t plane = 0; plane < 3; ++plane) {
            const int left = valid ? source.planes[plane](column, row) - prediction(plane, i) : 0;
            residual.left[plane][i] = static_cast<std::int16_t>(left);
        }
    }
    return residual;
}

}  // namespace

std::int64_t BlockResidual::error() const {
    std::int64_t sum = 0;
    for (std::size_t plane = 0; plane < 3; ++plane) {
        int of_plane = 0;
        for (const std::int16_t l : left[plane]) of_plane += l * l;
        sum += std::int64_t{kIntegerPlaneWeights[plane]} * of_plane;
    }
    return sum;
}

BlockResidual compute_flat_residual(const SourceImage& source, int x, int y,
                                    const std::array<std::uint8_t, 3>& colour) {
    return residual_of(source, x, y, [&](std::size_t plane, std::size_t) { return int{colour[plane]}; });
}

BlockResidual compute_prediction_residual(const SourceImage& source, int x, int y,
                                          const codec::ConstPlaneViews& reference, int from_x, int from_y) {
    return residual_of(source, x, y, [&](std::size_t plane, std::size_t i) {
        const ConstImageView<std::uint8_t>& from = reference[plane];
        return int{from(std::clamp(from_x + static_cast<int>(i % 8), 0, from.width() - 1),
                        std::clamp(from_y + static_cast<int>(i / 8), 0, from.height() - 1))};
    });
}

std::array<std::uint8_t, 3> mean_colour(const SourceImage& source, int x, int y) {
    std::array<int, 3> sum = {};
    int count = 0;
    for (int row = y; row < y + 8; ++row) {
        for (int column = x; column < x + 8; ++column) {
            if (source.valid(column, row) == 0) continue;
            ++count;
            for (std::size_t plane = 0; plane < 3; ++plane) sum[plane] += source.planes[plane](column, row);
        }
    }
    if (count == 0) return {codec::kEmptySample, codec::kEmptySample, codec::kEmptySample};
    std::array<std::uint8_t, 3> mean;
    for (std::size_t plane = 0; plane < 3; ++plane) {
        mean[plane] = static_cast<std::uint8_t>((2 * sum[plane] + count) / (2 * count));
    }
    return mean;
}

void block_vector(const BlockResidual& residual, const WeightedVectors::Place& out) {
    for (std::size_t i = 0; i < 64; ++i) {
        out.values[i] = residual.left[0][i];
        out.weights[i] = static_cast<std::int16_t>(kIntegerPlaneWeights[0] * residual.valid[i]);
    }
    for (std::size_t plane = 1; plane < 3; ++plane) {
        for (std::size_t pair = 0; pair < 16; ++pair) {
            int sum = 0;
            int count = 0;
            for (const std::size_t i : pixels_of_pair(pair)) {
                sum += residual.left[plane][i];
                count += residual.valid[i];
            }
            const std::size_t d = 48 + 16 * plane + pair;
            out.values[d] = static_cast<std::int16_t>(count == 0 ? 0 : (sum + (sum < 0 ? -count : count) / 2) / count);
            out.weights[d] = static_cast<std::int16_t>(kIntegerPlaneWeights[plane] * count);
        }
    }
}

void quarter_vector(const BlockResidual& residual, int quarter, const WeightedVectors::Place& out) {
    for (std::size_t plane = 0; plane < 3; ++plane) {
        for (std::size_t i = 0; i < 16; ++i) {
            const std::size_t pixel = pixel_of(static_cast<std::size_t>(quarter), i);
            out.values[16 * plane + i] = residual.left[plane][pixel];
            out.weights[16 * plane + i] =
                static_cast<std::int16_t>(kIntegerPlaneWeights[plane] * residual.valid[pixel]);
        }
    }
}

void subtract_block(BlockResidual& residual, const std::int16_t* entry) {
    for (std::size_t i = 0; i < 64; ++i) {
        const std::size_t pair = i / 16 * 4 + i % 8 / 2;
        const std::array<int, 3> off = {entry[i], entry[64 + pair], entry[80 + pair]};
        for (std::size_t plane = 0; plane < 3; ++plane) {
            residual.left[plane][i] =
                static_cast<std::int16_t>(residual.left[plane][i] - residual.valid[i] * off[plane]);
        }
    }
}

void subtract_quarter(BlockResidual& residual, int quarter, const std::int16_t* entry) {
    for (std::size_t plane = 0; plane < 3; ++plane) {
        for (std::size_t i = 0; i < 16; ++i) {
            const std::size_t pixel = pixel_of(static_cast<std::size_t>(quarter), i);
            residual.left[plane][pixel] =
                static_cast<std::int16_t>(residual.left[plane][pixel] - residual.valid[pixel] * entry[16 * plane + i]);
        }
    }
}

}  // namespace rs::encode
