#include "rayspace/codec/syntax.hpp"

namespace rs::codec::syntax {
namespace {

template <int kSize>
struct Scan {
    std::uint8_t at[kSize * kSize] = {};
    constexpr Scan() {
        int place = 0;
        for (int diagonal = 0; diagonal < 2 * kSize - 1; ++diagonal) {
            for (int v = 0; v < kSize; ++v) {
                const int u = diagonal - v;
                if (u >= 0 && u < kSize) at[place++] = static_cast<std::uint8_t>(v * kSize + u);
            }
        }
    }
};

constexpr Scan<8> kScan8;
constexpr Scan<16> kScan16;

}  // namespace

const std::uint8_t* scan_order(int size) {
    return size == 8 ? kScan8.at : kScan16.at;
}

}  // namespace rs::codec::syntax
