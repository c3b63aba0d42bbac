#include "encode/codec/board/board_codebooks.hpp"

#include "rayspace/base/parallel_loop.hpp"
#include "rayspace/codec/prediction_unit.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace rs::encode {
namespace {

using codec::kBlockDimensions;
using codec::kQuarterDimensions;

constexpr int kTrainingRounds = 2;
constexpr int kRoundsPerStage = 5;
constexpr double kPackedByte = 0.55;  // bytes in the file per byte of a codebook

struct Vector {
    std::array<std::int16_t, kBlockDimensions> values = {};
    std::array<std::int16_t, kBlockDimensions> weights = {};
    WeightedVectors::Place place() { return {values.data(), weights.data()}; }
};

std::uint8_t code_block(const Codebook& book, BlockResidual& residual) {
    Vector vector;
    block_vector(residual, vector.place());
    const std::size_t index = find_nearest_entry(book, vector.values.data(), vector.weights.data()).index;
    subtract_block(residual, &book.entries[index * kBlockDimensions]);
    return static_cast<std::uint8_t>(index);
}

std::uint8_t code_quarter(const Codebook& book, int quarter, BlockResidual& residual) {
    Vector vector;
    quarter_vector(residual, quarter, vector.place());
    const std::size_t index = find_nearest_entry(book, vector.values.data(), vector.weights.data()).index;
    subtract_quarter(residual, quarter, &book.entries[index * kQuarterDimensions]);
    return static_cast<std::uint8_t>(index);
}

WeightedVectors vectors_of(std::span<const BlockResidual> residuals, const std::vector<bool>& wanted, bool quarters) {
    WeightedVectors vectors;
    vectors.dimensions = quarters ? kQuarterDimensions : kBlockDimensions;
    for (std::size_t b = 0; b < residuals.size(); ++b) {
        if (!wanted[b]) continue;
        if (!quarters) {
            block_vector(residuals[b], vectors.add());
        } else {
            for (int q = 0; q < 4; ++q) quarter_vector(residuals[b], q, vectors.add());
        }
    }
    return vectors;
}

codec::Book stored(const Codebook& book) {
    codec::Book bytes(book.entries.size());
    std::transform(book.entries.begin(), book.entries.end(), bytes.begin(),
                   [](std::int16_t v) { return static_cast<std::int8_t>(v); });
    return bytes;
}

constexpr int kAlphaSamples = 16;
constexpr std::size_t kTrainingQuarters = 40000;

void alpha_vector(const SourceImage& source, int alpha_bits, int x, int y, const WeightedVectors::Place& out) {
    for (int i = 0; i < kAlphaSamples; ++i) {
        const int level = source.alpha(x + i % 4, y + i / 4);
        out.values[i] = static_cast<std::int16_t>(codec::alpha_of_level(level, alpha_bits) - 128);
        out.weights[i] = 1;
    }
}

bool is_mixed(const SourceImage& source, int x, int y) {
    const int first = source.alpha(x, y);
    for (int i = 1; i < kAlphaSamples; ++i) {
        if (source.alpha(x + i % 4, y + i / 4) != first) return true;
    }
    return false;
}

template <class Work>
void for_mixed_quarters(const std::vector<SourceImage>& sources, const Work& work) {
    for (const SourceImage& source : sources) {
        for (int y = 0; y < source.alpha.height(); y += 4) {
            for (int x = 0; x < source.alpha.width(); x += 4) {
                if (is_mixed(source, x, y)) work(source, x, y);
            }
        }
    }
}

}  // namespace

StagedBlock quantise_stages(const StageCodebooks& books, BlockResidual residual) {
    StagedBlock staged;
    std::size_t stage = 0;
    staged.error[stage++] = residual.error();
    for (std::size_t s = 0; s < books.block.size(); ++s) {
        staged.block[s] = code_block(books.block[s], residual);
        staged.error[stage++] = residual.error();
    }
    for (std::size_t s = 0; s < books.quarter.size(); ++s) {
        for (int q = 0; q < 4; ++q) {
            staged.quarter[s][static_cast<std::size_t>(q)] = code_quarter(books.quarter[s], q, residual);
        }
        staged.error[stage++] = residual.error();
    }
    return staged;
}

int count_stages(const codec::RecordClass& record_class) {
    return record_class.block_stages + record_class.quarter_stages;
}

int select_class(const StagedBlock& staged, const std::array<codec::RecordClass, codec::kBoardClasses>& classes,
                 unsigned may, double lambda) {
    int best = 0;
    double best_cost = std::numeric_limits<double>::max();
    for (int c = 1; c < codec::kBoardClasses; ++c) {
        if ((may >> static_cast<unsigned>(c) & 1U) == 0) continue;
        const codec::RecordClass& record_class = classes[static_cast<std::size_t>(c)];
        const double cost = static_cast<double>(staged.error[static_cast<std::size_t>(count_stages(record_class))]) +
                            lambda * record_class.bytes();
        if (cost < best_cost) {
            best = c;
            best_cost = cost;
        }
    }
    return best;
}

StageCodebooks train_stages(std::span<const TrainingBlock> blocks,
                            const std::array<codec::RecordClass, codec::kBoardClasses>& classes, int block_stages,
                            int quarter_stages, double lambda, double share) {
    StageCodebooks books;
    const int stages = block_stages + quarter_stages;
    std::vector<int> used(blocks.size(), stages);  // stages of each block
    for (int round = 0; round <= kTrainingRounds; ++round) {
        if (round > 0) {
            for_each_index(blocks.size(), [&](std::size_t b) {
                const StagedBlock staged = quantise_stages(books, blocks[b].residual);
                const int c = select_class(staged, classes, blocks[b].may, lambda);
                used[b] = count_stages(classes[static_cast<std::size_t>(c)]);
            });
        }
        std::vector<BlockResidual> residuals;
        residuals.reserve(blocks.size());
        for (const TrainingBlock& block : blocks) residuals.push_back(block.residual);
        for (int stage = 0; stage < stages; ++stage) {
            const bool quarters = stage >= block_stages;
            std::vector<bool> wanted(blocks.size());
            for (std::size_t b = 0; b < blocks.size(); ++b) wanted[b] = used[b] > stage;
            const WeightedVectors vectors = vectors_of(residuals, wanted, quarters);
            std::vector<Codebook>& group = quarters ? books.quarter : books.block;
            const auto at = static_cast<std::size_t>(quarters ? stage - block_stages : stage);
            if (round == 0) {
                group.push_back(train_codebook(vectors, codec::kBookEntries));
            } else {
                refine_codebook(group[at], vectors, kRoundsPerStage);
            }
            if (round == kTrainingRounds) {
                prune_codebook(group[at], vectors, share * lambda * kPackedByte * vectors.dimensions);
            }
            const Codebook& book = group[at];
            for_each_index(residuals.size(), [&](std::size_t b) {
                if (used[b] <= stage) return;
                if (!quarters) {
                    code_block(book, residuals[b]);
                } else {
                    for (int q = 0; q < 4; ++q) code_quarter(book, q, residuals[b]);
                }
            });
        }
    }
    return books;
}

codec::Books pack_codebooks(const StageCodebooks& books) {
    codec::Books all;
    for (std::size_t s = 0; s < books.block.size(); ++s) all.block[s] = stored(books.block[s]);
    for (std::size_t s = 0; s < books.quarter.size(); ++s) all.quarter[s] = stored(books.quarter[s]);
    return all;
}

unsigned AlphaCodebook::nearest(const SourceImage& source, int x, int y) const {
    std::int16_t values[kAlphaSamples];
    std::int16_t weights[kAlphaSamples];
    alpha_vector(source, alpha_bits, x, y, {values, weights});
    return static_cast<unsigned>(find_nearest_entry(book, values, weights).index);
}

AlphaCodebook train_alpha(const std::vector<SourceImage>& sources, int alpha_bits) {
    std::size_t count = 0;
    for_mixed_quarters(sources, [&](const SourceImage&, int, int) { ++count; });
    const std::size_t stride = std::max<std::size_t>(1, (count + kTrainingQuarters - 1) / kTrainingQuarters);
    WeightedVectors vectors;
    vectors.dimensions = kAlphaSamples;
    std::size_t number = 0;
    for_mixed_quarters(sources, [&](const SourceImage& source, int x, int y) {
        if (number++ % stride == 0) alpha_vector(source, alpha_bits, x, y, vectors.add());
    });
    AlphaCodebook alpha;
    alpha.alpha_bits = alpha_bits;
    alpha.book = train_codebook(vectors, codec::kBookEntries);
    alpha.samples.resize(alpha.book.entries.size());
    for (std::size_t i = 0; i < alpha.samples.size(); ++i) {
        int sample = std::clamp(alpha.book.entries[i] + 128, 0, 255);
        if (i < 2 * kAlphaSamples) sample = i < kAlphaSamples ? 255 : 0;
        sample = codec::alpha_of_level(codec::level_of_alpha(sample, alpha_bits), alpha_bits);
        alpha.samples[i] = static_cast<std::uint8_t>(sample);
        alpha.book.entries[i] = static_cast<std::int16_t>(sample - 128);
    }
    return alpha;
}

}  // namespace rs::encode
