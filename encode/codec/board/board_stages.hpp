#pragma once
// The chain of codebooks that the records of one kind (flat or predicted) go through, and how they are trained.
//
// The encoder uses classes that nest: a block stage or several, then quarter stages, each class a beginning of that
// chain. So one walk along it prices all of them.

#include "encode/codec/board/board_block.hpp"
#include "encode/codec/board/vector_quantiser.hpp"
#include "rayspace/codec/code/board_code.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::encode {

inline constexpr int kMaxStages = codec::kMaxBlockStages + codec::kMaxQuarterStages;

struct StageBooks {
    std::vector<TrainedBook> block;
    std::vector<TrainedBook> quarter;
    [[nodiscard]] int count() const { return static_cast<int>(block.size() + quarter.size()); }
};

struct StagedBlock {
    std::array<std::int64_t, kMaxStages + 1> error = {};                             // after so many stages
    std::array<std::uint8_t, codec::kMaxBlockStages> block = {};                     // indices
    std::array<std::array<std::uint8_t, 4>, codec::kMaxQuarterStages> quarter = {};  // [stage][quarter]
};

// Takes the nearest entry of each stage in turn.
StagedBlock walk_stages(const StageBooks& books, BlockResidual residual);

// What a block costs with class c: error + lambda * bytes, of the classes that `may` holds (bit c). `stages_of`: the
// number of stages of the chain.
int stages_of(const codec::RecordClass& record_class);
int cheapest_class(const StagedBlock& staged, const std::array<codec::RecordClass, codec::kBoardClasses>& classes,
                   unsigned may, double lambda);

struct TrainingBlock {
    BlockResidual residual;
    unsigned may = 0;  // classes that it may have
};

// Books for blocks that will be of the given classes, `block_stages` and `quarter_stages` of them. Later rounds train
// each stage on the blocks that are worth it. `share`: of all blocks, those that `blocks` holds; entries that do not
// save lambda for each byte that they take are left out.
StageBooks train_stages(std::span<const TrainingBlock> blocks,
                        const std::array<codec::RecordClass, codec::kBoardClasses>& classes, int block_stages,
                        int quarter_stages, double lambda, double share);

codec::Books stored_books(const StageBooks& books);

}  // namespace rs::encode
