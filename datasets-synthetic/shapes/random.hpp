#pragma once
// Portable random numbers: PCG32 (M. E. O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically Good
// Algorithms", 2014; the XSH-RR variant) and an integer hash for lattices. The results of the standard library's
// distributions are implementation-defined. Not thread-safe; copies repeat the sequence.

#include "datasets-synthetic/shapes/portable_math.hpp"
#include "rayspace/base/conventions.hpp"

#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>

namespace rs::synthetic {

class Random {
public:
    // Streams of one seed are independent: every part of an object uses its own, so that changing the number of petals
    // does not change the leaves.
    explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : increment_((stream << 1U) | 1U) {
        next();
        state_ += seed;
        next();
    }

    std::uint32_t next() {
        const std::uint64_t old = state_;
        state_ = old * 6364136223846793005ULL + increment_;
        const auto shifted = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
        const auto turn = static_cast<std::uint32_t>(old >> 59U);
        return (shifted >> turn) | (shifted << ((32U - turn) & 31U));
    }

    // In [0, 1) with 24 bits, so that every value is an exact float.
    float uniform() { return static_cast<float>(next() >> 8U) * (1.0F / 16777216.0F); }
    float uniform(float low, float high) { return low + (high - low) * uniform(); }

    // In [0, count), count >= 1, with a bias below 2^-32 * count.
    int below(int count) {
        return static_cast<int>((static_cast<std::uint64_t>(next()) * static_cast<std::uint64_t>(count)) >> 32U);
    }

    // Mean 0, standard deviation 1, bounded by +-3.47 (a sum of four uniforms).
    float bell() {
        float sum = -2.0F;
        for (int k = 0; k < 4; ++k) sum += uniform();
        return sum * 1.7320508F;
    }

    // Uniform on the unit sphere.
    glm::vec3 direction() {
        const float z = uniform(-1.0F, 1.0F);
        const float angle_rad = uniform(0.0F, 2.0F * static_cast<float>(kPi));
        const float r = std::sqrt(std::fmax(0.0F, 1.0F - z * z));
        return {r * portable::cos(angle_rad), z, r * portable::sin(angle_rad)};
    }

private:
    std::uint64_t state_ = 0;
    std::uint64_t increment_;
};

// Mixes a lattice point and a seed into 32 well-spread bits. The finisher is "lowbias32" (C. Wellons, 2018).
inline std::uint32_t lattice_hash(int x, int y, int z, std::uint32_t seed) {
    std::uint32_t h = seed * 0x9E3779B9U + static_cast<std::uint32_t>(x) * 0x85EBCA6BU +
                      static_cast<std::uint32_t>(y) * 0xC2B2AE35U + static_cast<std::uint32_t>(z) * 0x27D4EB2FU;
    h = (h ^ (h >> 16U)) * 0x7FEB352DU;
    h = (h ^ (h >> 15U)) * 0x846CA68BU;
    return h ^ (h >> 16U);
}

}  // namespace rs::synthetic
