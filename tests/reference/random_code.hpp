#pragma once
// Valid random payloads of the chunk CODE, of both profiles.

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

/// `levels`: levels of the views. With a tame code the random bytes of a tile give image-like samples; otherwise
/// samples soon saturate at 0 or 255.
[[nodiscard]] std::vector<std::uint8_t> random_dense_code(const std::vector<int>& levels, bool is_tame, Random& random);
[[nodiscard]] std::vector<std::uint8_t> random_board_code(const std::vector<int>& levels, bool is_tame, Random& random);

}  // namespace rs::reference
