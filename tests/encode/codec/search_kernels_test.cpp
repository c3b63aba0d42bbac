// Compares the encoder's search kernels with plain formulas; compares effort levels.

#include "encode/codec/search_kernels.hpp"

#include "encode/codec/coders.hpp"
#include "encode/codec/dense_encoder.hpp"
#include "rayspace/codec/stream/decode_image.hpp"
#include "rayspace/codec/syntax.hpp"
#include "tests/support/coded_object.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <random>
#include <vector>

namespace rs::encode {
namespace {

constexpr int kStride = 40;

struct Samples {
    std::vector<std::uint8_t> wanted = std::vector<std::uint8_t>(kStride * 16);
    std::vector<std::uint8_t> mask = wanted;
    std::vector<std::uint8_t> reconstruction = wanted;
    std::vector<std::uint8_t> other = wanted;

    explicit Samples(std::mt19937& random) {
        const unsigned span = 1U << (random() % 9);
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            wanted[i] = static_cast<std::uint8_t>(random() % 256);
            reconstruction[i] = static_cast<std::uint8_t>(std::min(wanted[i] + random() % span, 255UL));
            other[i] = static_cast<std::uint8_t>(random() % 256);
            mask[i] = random() % 4 == 0 ? 0 : 255;
        }
    }
    [[nodiscard]] SampleBlock target(int size) const { return {wanted.data(), mask.data(), kStride, size}; }
    [[nodiscard]] int off(int x, int y) const {
        const auto at = static_cast<std::size_t>(y * kStride + x);
        return mask[at] != 0 ? wanted[at] - reconstruction[at] : 0;
    }
};

TEST(SearchKernels, SumsAreThoseOfTheFormulas) {
    std::mt19937 random(1);
    for (int round = 0; round < 200; ++round) {
        const Samples samples(random);
        for (const int size : {8, 16}) {
            int absolute = 0;
            int squared = 0;
            int of_mean = 0;
            for (int y = 0; y < size; ++y) {
                for (int x = 0; x < size; ++x) {
                    const auto at = static_cast<std::size_t>(y * kStride + x);
                    absolute += std::abs(samples.off(x, y));
                    squared += samples.off(x, y) * samples.off(x, y);
                    const int mean =
                        (samples.reconstruction[at] + samples.other[static_cast<std::size_t>(y * size + x)] + 1) / 2;
                    of_mean += samples.mask[at] != 0 ? std::abs(samples.wanted[at] - mean) : 0;
                }
            }
            const SampleBlock target = samples.target(size);
            ASSERT_EQ(absolute_differences(target, samples.reconstruction.data(), kStride), absolute);
            ASSERT_EQ(squared_differences(target, samples.reconstruction.data(), kStride), squared);
            ASSERT_EQ(
                absolute_differences_of_mean(target, samples.reconstruction.data(), kStride, samples.other.data()),
                of_mean);
        }
    }
}

// Entry (v, u) of a block is the sum over its samples times (-1)^(number of common bits of v and y, and of u and x).
TEST(SearchKernels, HadamardTransformsAreThoseOfTheFormula) {
    std::mt19937 random(2);
    for (int round = 0; round < 40; ++round) {
        const Samples samples(random);
        for (const int size : {8, 16}) {
            int sum = 0;
            for (int block = 0; block < size * size / 64; ++block) {
                int magnitudes = 0;
                for (unsigned v = 0; v < 8; ++v) {
                    for (unsigned u = 0; u < 8; ++u) {
                        int entry = 0;
                        for (unsigned y = 0; y < 8; ++y) {
                            for (unsigned x = 0; x < 8; ++x) {
                                const int off = samples.off(8 * (block % 2) + static_cast<int>(x),
                                                            8 * (block / 2) + static_cast<int>(y));
                                entry += (std::popcount(v & y) + std::popcount(u & x)) % 2 == 0 ? off : -off;
                            }
                        }
                        magnitudes += std::abs(entry);
                    }
                }
                sum += (magnitudes + 4) / 8;
            }
            ASSERT_EQ(hadamard_differences(samples.target(size), samples.reconstruction.data(), kStride), sum);
        }
    }
}

TEST(SearchKernels, TheForwardTransformIsTheMatrixFromBothSides) {
    std::mt19937 random(3);
    for (int round = 0; round < 20; ++round) {
        for (const int size : {8, 16}) {
            const int row_step = 16 / size;
            const int log2 = size == 8 ? 3 : 4;
            std::vector<std::int16_t> residual(static_cast<std::size_t>(size * size));
            for (auto& r : residual) r = static_cast<std::int16_t>(static_cast<int>(random() % 511) - 255);
            std::vector<std::int32_t> found(residual.size());
            forward_transform(residual.data(), size, found.data());
            for (int v = 0; v < size; ++v) {
                for (int u = 0; u < size; ++u) {
                    std::int32_t sum = 0;
                    for (int x = 0; x < size; ++x) {
                        std::int32_t column = 0;
                        for (int y = 0; y < size; ++y) {
                            column +=
                                codec::kTransform16[v * row_step][y] * residual[static_cast<std::size_t>(y * size + x)];
                        }
                        sum += codec::kTransform16[u * row_step][x] * ((column + (1 << (log2 - 2))) >> (log2 - 1));
                    }
                    ASSERT_EQ(found[static_cast<std::size_t>(v * size + u)], (sum + (1 << (log2 + 5))) >> (log2 + 6));
                }
            }
        }
    }
}

TEST(CostTable, LevelsCostWhatTheirDecisionsDo) {
    std::mt19937 random(4);
    Probabilities probabilities;
    for (auto& p : probabilities) p = static_cast<std::uint16_t>(16 * (1 + random() % 255));
    const CostTable costs(probabilities);
    for (int round = 0; round < 5000; ++round) {
        const int kind = static_cast<int>(random() % 8);
        const int band = static_cast<int>(random() % 4);
        const int near = static_cast<int>(random() % 5);
        const bool must_be = random() % 2 == 0;
        const int level = static_cast<int>(random() % 40) + (must_be ? 1 : 0);
        CostEstimator bits(costs);
        codec::syntax::magnitude(bits, kind, band, near, must_be, level);
        ASSERT_NEAR(costs.level(kind, band, near, must_be, level), bits.bits() + (level != 0 ? 1.0F : 0.0F), 1e-4);
        const int size = (kind & 2) != 0 ? 16 : 8;
        const int place = static_cast<int>(random() % static_cast<unsigned>(size * size));
        CostEstimator of_place(costs);
        codec::syntax::last_place(of_place, kind, size, place);
        ASSERT_NEAR(costs.last_place(kind, place), of_place.bits(), 1e-4);
    }
}

// Uses drawn images, whose modes differ little.
TEST(SearchEffort, MoreOfItGivesABetterBargain) {
    RaySpaceObject object = test::small_object({.views_per_ring = 12, .width = 160, .height = 96});
    const std::vector<Image<Rgba8>> images = test::drawn_images(object);
    std::vector<SourceImage> sources;
    for (const auto& image : images) sources.push_back(source_image(image, 2));
    // Bytes, plus the error as equivalent bytes: a decibel is about a seventh of the bytes.
    const auto price = [&](int effort) {
        DenseSettings settings;
        settings.step = 8;
        settings.effort = effort;
        const EncodedImages encoded = encode_dense(object, sources, settings);
        double bytes = 0;
        for (const auto& image : encoded.coded.images) bytes += static_cast<double>(image.bytes.size());
        return bytes * std::pow(10.0, -encoded.psnr_db / 16);
    };
    const double most = price(kMaxEffort);
    EXPECT_LT(most, price(kMinEffort));
    EXPECT_LT(price(kDefaultEffort), 1.1 * most);
    EXPECT_LT(price(kMinEffort), 1.3 * most);
}

}  // namespace
}  // namespace rs::encode
