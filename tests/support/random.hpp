#pragma once
// Random numbers for tests, the same in every run.

#include <cstdint>
#include <random>

namespace rs::test {

class Random {
public:
    explicit Random(std::uint64_t seed) : engine(seed) {}
    double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
    int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine); }

    std::mt19937_64 engine;
};

}  // namespace rs::test
