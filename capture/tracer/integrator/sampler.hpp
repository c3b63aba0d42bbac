#pragma once
// Random numbers for one path, a pure function of (seed, pixel, sample, dimension), so that images do not depend on
// threads or tiles.
//
// Each call draws from the first two dimensions of the Sobol sequence; the order of the samples and both coordinates
// are Owen-scrambled by hashes of pixel and dimension (B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4),
// 2020). The first N samples of a pixel are stratified in every pair of dimensions, best if N is a power of two.

#include <glm/glm.hpp>

#include <cstdint>

namespace rs::capture {

// A bijection of 64-bit words whose output bits depend on all input bits (the finaliser of SplitMix64).
constexpr std::uint64_t mix_bits(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15ULL;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
    return x ^ (x >> 31);
}

class Sampler {
public:
    // `pixel_key` is a hash of seed and pixel; `sample` counts the pixel's paths from 0.
    Sampler(std::uint64_t pixel_key, std::uint32_t sample)
        : pixel_key_(pixel_key), reversed_sample_(reverse_bits(sample)) {}

    // Numbers in [0, 1). Consecutive calls are consecutive dimensions.
    glm::vec2 next_2d() {
        const std::uint64_t key = mix_bits(pixel_key_ + dimension_++ * 0xD1342543DE82EF95ULL);
        const std::uint64_t second_key = mix_bits(key);
        const std::uint32_t index = reverse_bits(scramble(reversed_sample_, static_cast<std::uint32_t>(key)));
        const std::uint32_t x = reverse_bits(scramble(index, static_cast<std::uint32_t>(key >> 32)));
        const std::uint32_t y = reverse_bits(scramble(pascal(index), static_cast<std::uint32_t>(second_key)));
        return {to_unit(x), to_unit(y)};
    }

    [[nodiscard]] std::uint32_t sample() const { return reverse_bits(reversed_sample_); }

private:
    static constexpr std::uint32_t reverse_bits(std::uint32_t x) {
        x = __builtin_bswap32(x);
        x = ((x & 0x0F0F0F0FU) << 4) | ((x >> 4) & 0x0F0F0F0FU);
        x = ((x & 0x33333333U) << 2) | ((x >> 2) & 0x33333333U);
        return ((x & 0x55555555U) << 1) | ((x >> 1) & 0x55555555U);
    }
    // Owen scrambling of bit-reversed numbers: a bit is changed only by bits below it (Laine-Karras, constants of
    // Burley's paper, listing 2).
    static constexpr std::uint32_t scramble(std::uint32_t x, std::uint32_t seed) {
        x += seed;
        x ^= x * 0x6C50B47CU;
        x ^= x * 0xB82F1E52U;
        x ^= x * 0xC7AFE638U;
        x ^= x * 0x8D22F6E6U;
        return x;
    }
    // The second Sobol dimension, bit-reversed: the Pascal matrix modulo 2, whose entry (j, k) is 1 where the bits of j
    // are a subset of those of k, applied one bit of the indices at a time.
    static constexpr std::uint32_t pascal(std::uint32_t x) {
        x ^= (x >> 1) & 0x55555555U;
        x ^= (x >> 2) & 0x33333333U;
        x ^= (x >> 4) & 0x0F0F0F0FU;
        x ^= (x >> 8) & 0x00FF00FFU;
        return x ^ ((x >> 16) & 0x0000FFFFU);
    }
    static float to_unit(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24F; }

    std::uint64_t pixel_key_;
    std::uint64_t dimension_ = 0;
    std::uint32_t reversed_sample_;
};

}  // namespace rs::capture
