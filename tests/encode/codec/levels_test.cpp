// Context adaptation in a tile, and levels with hidden signs from quantisation to decoding.

#include "encode/codec/quantise.hpp"
#include "rayspace/codec/bool_decoder.hpp"
#include "rayspace/codec/bool_encoder.hpp"
#include "rayspace/codec/context_states.hpp"
#include "rayspace/codec/syntax.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <utility>

namespace rs::encode {
namespace {

namespace context = codec::context;

Probabilities random_probabilities(std::mt19937& random) {
    Probabilities probabilities;
    for (auto& p : probabilities) p = static_cast<std::uint16_t>(16 * (1 + random() % 255));
    return probabilities;
}

TEST(ContextStates, StayWithinWhatADecoderTakesAndFollowWhatIsSaid) {
    codec::DenseCode code;
    for (const int listed : {1, 128, 255}) {
        code.probabilities.fill(static_cast<std::uint16_t>(16 * listed));
        for (const int context : {0, context::kNonZero, context::kMask}) {
            for (const int bit : {0, 1}) {
                codec::ContextStates states(code);
                EXPECT_EQ(states.probability(context), 16U * static_cast<unsigned>(listed));
                for (int i = 0; i < 5000; ++i) states.adapt(context, bit);
                EXPECT_EQ(states.probability(context + 1), 16U * static_cast<unsigned>(listed));
                // A shift by 7 converges to 127 / 65536 before the end.
                EXPECT_EQ(states.probability(context), bit == 0 ? 4088U : 8U);
            }
        }
    }
}

TEST(ContextStates, TheFirstStepsAreThoseOfTheFormat) {
    codec::DenseCode code;
    code.probabilities.fill(2048);
    codec::ContextStates states(code);
    // n = 8, s = 3: z = 32768 + 4096, then 36864 - 4608 = 32256, eight in all; then n = 16, s = 4.
    states.adapt(context::kMask, 0);
    EXPECT_EQ(states.probability(context::kMask), 36864U >> 4U);
    states.adapt(context::kMask, 1);
    EXPECT_EQ(states.probability(context::kMask), 32256U >> 4U);
    for (int i = 0; i < 6; ++i) states.adapt(context::kMask, i & 1);
    std::uint32_t z = 32256;
    for (int i = 0; i < 6; ++i) z = (i & 1) == 0 ? z + ((65536 - z) >> 3U) : z - (z >> 3U);
    EXPECT_EQ(states.probability(context::kMask), z >> 4U);
    states.adapt(context::kMask, 0);
    EXPECT_EQ(states.probability(context::kMask), (z + ((65536 - z) >> 4U)) >> 4U);
    // n = 16 and n = 64.
    states.adapt(context::kNonZero - 1, 0);
    EXPECT_EQ(states.probability(context::kNonZero - 1), (32768U + 2048U) >> 4U);
    states.adapt(context::kNonZero, 0);
    EXPECT_EQ(states.probability(context::kNonZero), (32768U + 512U) >> 4U);
}

TEST(ContextStates, DoNotMoveWithoutAdaptation) {
    codec::DenseCode code;
    code.adaptation = false;
    std::mt19937 random(3);
    code.probabilities = random_probabilities(random);
    codec::ContextStates states(code);
    for (int i = 0; i < 20000; ++i) states.adapt(static_cast<int>(random() % context::kCount), i & 1);
    for (int c = 0; c < context::kCount; ++c) {
        ASSERT_EQ(states.probability(c), code.probabilities[static_cast<std::size_t>(c)]) << c;
    }
}

// A writing and a reading coder with even probabilities.
struct Writer {
    codec::BoolEncoder& bits;
    int bit(int /*context*/, int value) {
        bits.bit(value, 2048);
        return value;
    }
    int raw(int value) { return bit(0, value); }
};
struct Reader {
    codec::BoolDecoder& bits;
    int raws = 0;
    int bit(int /*context*/, int /*value*/) { return bits.bit(2048); }
    int raw(int /*value*/) {
        ++raws;
        return bits.bit(2048);
    }
};

struct Quantised {
    codec::Levels levels;
    int last = 0;
    bool any = false;
};

Quantised quantised(const std::vector<std::int32_t>& coefficients, int size, int step, bool sign_data_hiding,
                    const CostTable& costs) {
    Quantised result;
    result.any = quantise(coefficients.data(), {size, 2, step, 1.0F, 30.0F, sign_data_hiding}, costs, result.levels,
                          result.last);
    return result;
}

// The levels after writing and reading, and the number of their raw bits.
std::pair<codec::Levels, int> read_back(const Quantised& quantised, int size, bool sign_data_hiding) {
    codec::BoolEncoder encoder;
    Writer writer{encoder};
    codec::Levels levels = quantised.levels;
    codec::syntax::block(writer, 2, size, sign_data_hiding, levels, quantised.last);
    const auto bytes = encoder.finish();
    codec::BoolDecoder decoder(bytes);
    Reader reader{decoder};
    levels = {};
    codec::syntax::block(reader, 2, size, sign_data_hiding, levels, 0);
    return {levels, reader.raws};
}

TEST(SignDataHiding, AreReadBackFromFewerBits) {
    std::mt19937 random(7);
    int saved = 0;
    for (int round = 0; round < 4000; ++round) {
        const CostTable costs(random_probabilities(random));
        const int size = round % 2 == 0 ? 8 : 16;
        std::vector<std::int32_t> coefficients(static_cast<std::size_t>(size * size));
        const int span = 20 << (round % 9);
        for (std::size_t i = 0; i < coefficients.size(); ++i) {
            const int most =
                1 +
                span / (1 + static_cast<int>(i % static_cast<std::size_t>(size) + i / static_cast<std::size_t>(size)));
            coefficients[i] = static_cast<int>(random() % static_cast<unsigned>(2 * most + 1)) - most;
        }
        const Quantised hidden = quantised(coefficients, size, 20, true, costs);
        if (!hidden.any) continue;
        const auto [read, raws] = read_back(hidden, size, true);
        const auto [plain, plain_raws] = read_back(hidden, size, false);
        for (int v = 0; v < size; ++v) {
            for (int u = 0; u < size; ++u) {
                const int place = v * codec::Levels::kStride + u;
                ASSERT_EQ(read.at[place], hidden.levels.at[place]) << round << ": " << u << ", " << v;
                ASSERT_EQ(plain.at[place], hidden.levels.at[place]);
            }
        }
        EXPECT_EQ(read.used, hidden.levels.used);
        ASSERT_LE(raws, plain_raws);
        saved += plain_raws - raws;
    }
    EXPECT_GT(saved, 4000);
}

// At most one level per group is changed, by one.
TEST(SignDataHiding, ChangeOneLevelOfAGroupByOne) {
    std::mt19937 random(8);
    int changed_groups = 0;
    for (int round = 0; round < 2000; ++round) {
        const CostTable costs(random_probabilities(random));
        const int size = round % 2 == 0 ? 8 : 16;
        std::vector<std::int32_t> coefficients(static_cast<std::size_t>(size * size));
        for (auto& c : coefficients) c = static_cast<int>(random() % 1201) - 600;
        const Quantised plain = quantised(coefficients, size, 20, false, costs);
        const Quantised hidden = quantised(coefficients, size, 20, true, costs);
        ASSERT_EQ(plain.any, hidden.any);
        ASSERT_LE(hidden.last, plain.last);
        const std::uint8_t* const scan = codec::syntax::scan_order(size);
        for (int begin = 0; begin < size * size; begin += codec::syntax::kSignGroup) {
            int off = 0;
            for (int i = begin; i < begin + codec::syntax::kSignGroup; ++i) {
                const int place = (scan[i] / size) * codec::Levels::kStride + (scan[i] & (size - 1));
                off += std::abs(plain.levels.at[place] - hidden.levels.at[place]);
            }
            ASSERT_LE(off, 1) << round << ", group at " << begin;
            changed_groups += off;
        }
    }
    EXPECT_GT(changed_groups, 1000);
}

}  // namespace
}  // namespace rs::encode
