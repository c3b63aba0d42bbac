#pragma once
// Arithmetic units of the board, as functions without a clock, with their latencies. Quotients and products are those
// of engine/RECONSTRUCTION.md; divide_serially and multiply_serially follow the steps of the hardware, one row of logic
// cells per step. A test compares both.

#include <cstdint>

namespace rs::engine::model {

// Pipelined divider: sign and magnitude in, 32 stages of one quotient bit (a 33-bit subtract and a choice each), sign
// and floor out. A new division may enter in every cycle.
inline constexpr int kDivideCycles = 34;

// Pipelined multiplier: 36 x 36 bits signed, of four 18 x 18 ones; a product may enter in every cycle.
inline constexpr int kProductCycles = 5;

// Square root, 32 bits of the result one after the other (a 34-bit subtract and a choice each), and its register.
inline constexpr int kRootCycles = 33;

// Serial multiplier: 36 x 36 bits signed, 4 bits of the multiplier a cycle. One product at a time.
inline constexpr int kMultiplyCycles = 9;

// Quotient; `overflow` if its magnitude is 2^32 or more.
struct Quotient {
    std::int64_t value = 0;
    bool overflow = false;
};

// floor(dividend / divisor), divisor 1 .. 2^32 - 1, |dividend| below 2^63.
constexpr Quotient divide(std::int64_t dividend, std::int64_t divisor) {
    const std::int64_t quotient = dividend / divisor;
    const std::int64_t floored = quotient * divisor > dividend ? quotient - 1 : quotient;
    const std::int64_t magnitude = quotient < 0 ? -quotient : quotient;
    if (magnitude >> 32 != 0) return {0, true};
    return {floored, false};
}

// divide() by the stages of the pipeline.
constexpr Quotient divide_serially(std::int64_t dividend, std::int64_t divisor) {
    const bool negative = dividend < 0;
    const auto magnitude = negative ? ~static_cast<std::uint64_t>(dividend) + 1 : static_cast<std::uint64_t>(dividend);
    const auto d = static_cast<std::uint64_t>(divisor);
    std::uint64_t rest = magnitude >> 32U;
    if (rest >= d) return {0, true};
    std::uint64_t quotient = 0;
    for (int bit = 31; bit >= 0; --bit) {
        rest = (rest << 1U) | ((magnitude >> static_cast<unsigned>(bit)) & 1U);
        const bool fits = rest >= d;
        if (fits) rest -= d;
        quotient = (quotient << 1U) | static_cast<std::uint64_t>(fits);
    }
    const auto value = static_cast<std::int64_t>(quotient);
    if (!negative) return {value, false};
    return {rest == 0 ? -value : -value - 1, false};
}

// Floor of the square root of `square`, by the steps of the hardware.
constexpr std::int64_t square_root_serially(std::uint64_t square) {
    std::uint64_t root = 0;
    std::uint64_t rest = 0;
    for (int bit = 31; bit >= 0; --bit) {
        rest = (rest << 2U) | ((square >> static_cast<unsigned>(2 * bit)) & 3U);
        const std::uint64_t trial = (root << 2U) | 1U;
        root <<= 1U;
        if (rest >= trial) {
            rest -= trial;
            root |= 1U;
        }
    }
    return static_cast<std::int64_t>(root);
}

// floor(sum / weight) by a table of 64 reciprocals and a product: weight 1 .. 64, sum below 2041 * weight. Sums of
// weighted depths are in this range.
constexpr std::int32_t divide_by_weight(std::int32_t sum, int weight) {
    constexpr int kShift = 23;
    const std::int64_t reciprocal = ((std::int64_t{1} << kShift) + weight - 1) / weight;
    return static_cast<std::int32_t>((sum * reciprocal) >> kShift);
}

// a * b for |b| below 2^35, by nine steps of 4 bits of b; the product must fit 64 bits.
constexpr std::int64_t multiply_serially(std::int64_t a, std::int64_t b) {
    std::uint64_t sum = 0;
    const auto digits = static_cast<std::uint64_t>(b);
    for (int step = 0; step < kMultiplyCycles; ++step) {
        const std::uint64_t digit = (digits >> static_cast<unsigned>(4 * step)) & 15U;
        // The top digit has the sign: -8 .. 7.
        const auto factor = step == kMultiplyCycles - 1 && digit >= 8 ? digit - 16 : digit;
        sum += (static_cast<std::uint64_t>(a) * factor) << static_cast<unsigned>(4 * step);
    }
    return static_cast<std::int64_t>(sum);
}

}  // namespace rs::engine::model
