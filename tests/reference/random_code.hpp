#pragma once
// Random payloads of the chunk CODE that break no rule, of both profiles.

#include <cstdint>
#include <random>
#include <vector>

namespace rs::reference {

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
    bool one_in(int n) { return whole(1, n) == 1; }

private:
    std::mt19937_64 engine_;
};

inline void put(std::vector<std::uint8_t>& bytes, int value) {
    bytes.push_back(static_cast<std::uint8_t>(value));
}

inline void put16(std::vector<std::uint8_t>& bytes, int value) {
    put(bytes, value & 255);
    put(bytes, (value >> 8) & 255);
}

// `levels`: of the views. Under a tame code the random bytes of a tile become something image-like; without, samples
// are soon at 0 or 255.
[[nodiscard]] std::vector<std::uint8_t> random_dense_code(const std::vector<int>& levels, bool is_tame, Random& random);
[[nodiscard]] std::vector<std::uint8_t> random_board_code(const std::vector<int>& levels, bool is_tame, Random& random);

}  // namespace rs::reference
