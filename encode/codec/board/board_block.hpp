#pragma once
// One block of 8x8 pixels on its way through the stages of the board profile: what is left to be coded of it.

#include "encode/codec/board/vector_quantiser.hpp"
#include "encode/codec/source_image.hpp"
#include "rayspace/codec/code/board_code.hpp"
#include "rayspace/codec/dense_tile.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace rs::encode {

// Weights of squared errors of Y, U, V in whole numbers: kPlaneWeights, doubled.
inline constexpr std::array<std::int16_t, 3> kWholePlaneWeights = {6, 7, 5};

struct BlockResidual {
    std::array<std::array<std::int16_t, 64>, 3> left;  // of Y, U, V; 0 where the sample is not valid
    std::array<std::int16_t, 64> valid;                // 1 or 0

    // Sum of weight * left^2.
    [[nodiscard]] std::int64_t error() const;
};

// The block at (x, y): source less prediction. `colour`: Y, U, V.
BlockResidual residual_of_flat(const SourceImage& source, int x, int y, const std::array<std::uint8_t, 3>& colour);
BlockResidual residual_of_predicted(const SourceImage& source, int x, int y, const codec::ConstPlaneViews& reference,
                                    int from_x, int from_y);

// The mean colour of the valid samples of the block; grey where there are none.
std::array<std::uint8_t, 3> mean_colour(const SourceImage& source, int x, int y);

// What a stage of whole blocks, or of quarter `quarter`, sees of the residual: kBlockDimensions or kQuarterDimensions
// components, as in a codebook.
void block_vector(const BlockResidual& residual, const WeightedVectors::Place& out);
void quarter_vector(const BlockResidual& residual, int quarter, const WeightedVectors::Place& out);

// Takes an entry of a codebook away from the residual.
void subtract_block(BlockResidual& residual, const std::int16_t* entry);
void subtract_quarter(BlockResidual& residual, int quarter, const std::int16_t* entry);

}  // namespace rs::encode
