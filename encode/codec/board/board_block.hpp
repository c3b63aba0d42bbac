#pragma once
// Residual of a block of 8x8 pixels in the stages of the board profile.

#include "encode/codec/board/vector_quantiser.hpp"
#include "encode/codec/encoder_images.hpp"
#include "rayspace/codec/code/board_code.hpp"
#include "rayspace/codec/dense_tile.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace rs::encode {

/// Integer weights of squared errors of Y, U, V: kPlaneWeights, doubled.
inline constexpr std::array<std::int16_t, 3> kIntegerPlaneWeights = {6, 7, 5};

struct BlockResidual {
    std::array<std::array<std::int16_t, 64>, 3> left;  // remaining error of Y, U, V; 0 where the sample is not valid
    std::array<std::int16_t, 64> valid;                // 1 or 0

    /// Sum of weight * left^2.
    [[nodiscard]] std::int64_t error() const;
};

/// Residuals of the block at (x, y): source minus prediction. `colour`: Y, U, V.
BlockResidual compute_flat_residual(const SourceImage& source, int x, int y, const std::array<std::uint8_t, 3>& colour);
BlockResidual compute_prediction_residual(const SourceImage& source, int x, int y,
                                          const codec::ConstPlaneViews& reference, int from_x, int from_y);

/// The mean colour of the block's valid samples; grey if there are none.
std::array<std::uint8_t, 3> mean_colour(const SourceImage& source, int x, int y);

/// Writes the residual as the vector of a block stage, or of quarter `quarter` in a quarter stage: kBlockDimensions or
/// kQuarterDimensions components, as in a codebook.
void block_vector(const BlockResidual& residual, const WeightedVectors::Place& out);
void quarter_vector(const BlockResidual& residual, int quarter, const WeightedVectors::Place& out);

/// Subtracts a codebook entry from the residual.
void subtract_block(BlockResidual& residual, const std::int16_t* entry);
void subtract_quarter(BlockResidual& residual, int quarter, const std::int16_t* entry);

}  // namespace rs::encode
