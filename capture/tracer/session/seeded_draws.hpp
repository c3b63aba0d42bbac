#pragma once
// Random number stream for one purpose, derived from a seed. Streams of different purposes are independent, so that an
// additional draw for the board does not change the angles. Not thread-safe.

#include "capture/tracer/integrator/sampler.hpp"
#include "rayspace/base/conventions.hpp"

#include <cmath>
#include <cstdint>

namespace rs::capture {

class SeededDraws {
public:
    SeededDraws(std::uint64_t seed, std::uint64_t purpose) : state_(mix_bits(mix_bits(seed) ^ mix_bits(~purpose))) {}

    // In [0, 1).
    double uniform() { return static_cast<double>(next() >> 11U) * 0x1p-53; }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }

    // Mean 0, standard deviation 1 (Box and Muller).
    double normal() {
        const double radius = std::sqrt(-2 * std::log(1 - uniform()));
        return radius * std::cos(2 * kPi * uniform());
    }

private:
    std::uint64_t next() { return mix_bits(state_++ * 0xD1342543DE82EF95ULL); }

    std::uint64_t state_;
};

}  // namespace rs::capture
