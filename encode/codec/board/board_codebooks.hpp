#pragma once
// Codebooks of the board profile and their training: the chain that records of one kind (flat or predicted) go through,
// and the alpha codebook.
//
// The encoder's classes nest: a class has one or more block stages, then quarter stages, and is a prefix of the chain.
// A single walk along the chain therefore prices all classes.

#include "encode/codec/board/board_block.hpp"
#include "encode/codec/board/vector_quantiser.hpp"
#include "encode/codec/encoder_images.hpp"
#include "rayspace/codec/code/board_code.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::encode {

inline constexpr int kMaxStages = codec::kMaxBlockStages + codec::kMaxQuarterStages;

struct StageCodebooks {
    std::vector<Codebook> block;
    std::vector<Codebook> quarter;
    [[nodiscard]] int count() const { return static_cast<int>(block.size() + quarter.size()); }
};

struct StagedBlock {
    std::array<std::int64_t, kMaxStages + 1> error = {};                             // [number of stages applied]
    std::array<std::uint8_t, codec::kMaxBlockStages> block = {};                     // indices
    std::array<std::array<std::uint8_t, 4>, codec::kMaxQuarterStages> quarter = {};  // [stage][quarter]
};

/// Quantises a block with the nearest entry of each stage in turn.
StagedBlock quantise_stages(const StageCodebooks& books, BlockResidual residual);

/// The number of stages of a class.
int count_stages(const codec::RecordClass& record_class);
/// The class of the lowest cost, error + lambda * bytes, among those with bit c set in `may`.
int select_class(const StagedBlock& staged, const std::array<codec::RecordClass, codec::kBoardClasses>& classes,
                 unsigned may, double lambda);

struct TrainingBlock {
    BlockResidual residual;
    unsigned may = 0;  // allowed classes, bit c for class c
};

/// Trains `block_stages` and `quarter_stages` codebooks for blocks of the given classes. Later rounds train each stage
/// on the blocks that use it. Entries that do not save lambda for each byte they take are removed.
/// \param share  number of `blocks` relative to all blocks of the kind.
StageCodebooks train_stages(std::span<const TrainingBlock> blocks,
                            const std::array<codec::RecordClass, codec::kBoardClasses>& classes, int block_stages,
                            int quarter_stages, double lambda, double share);

codec::Books pack_codebooks(const StageCodebooks& books);

/// Alpha codebook: 256 patterns of 4x4 samples.
struct AlphaCodebook {
    Codebook book;  // `samples` minus 128
    std::vector<std::uint8_t>
        samples;  // as stored: [entry * 16 + 4 row + column], values that alpha_bits can represent
    int alpha_bits = 2;

    /// The index of the entry nearest to the 4x4 samples at (x, y).
    [[nodiscard]] unsigned nearest(const SourceImage& source, int x, int y) const;
};

/// Trains the codebook on the quarters of partly covered blocks. Entry 0 is fully covered, entry 1 fully transparent.
AlphaCodebook train_alpha(const std::vector<SourceImage>& sources, int alpha_bits);

}  // namespace rs::encode
