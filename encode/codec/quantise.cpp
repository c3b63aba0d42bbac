#include "encode/codec/quantise.hpp"

#include "rayspace/codec/syntax.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace rs::encode {
namespace {

constexpr int kLargest = codec::kLargestTransform;

template <int kSize>
void forward(const std::int16_t* residual, std::int32_t* coefficients) {
    constexpr int kRowStep = kLargest / kSize;
    constexpr int kLog2 = kSize == 8 ? 3 : 4;
    constexpr int kFirstShift = kLog2 - 1;
    constexpr int kSecondShift = kLog2 + 6;
    std::int32_t columns[kSize * kSize];  // [v][x]
    for (int v = 0; v < kSize; ++v) {
        std::int32_t sums[kSize] = {};
        for (int y = 0; y < kSize; ++y) {
            const std::int32_t factor = codec::kTransform16[v * kRowStep][y];
            for (int x = 0; x < kSize; ++x) sums[x] += factor * residual[y * kSize + x];
        }
        for (int x = 0; x < kSize; ++x) columns[v * kSize + x] = (sums[x] + (1 << (kFirstShift - 1))) >> kFirstShift;
    }
    std::int32_t turned[kSize * kSize];  // [x][v]
    for (int v = 0; v < kSize; ++v) {
        for (int x = 0; x < kSize; ++x) turned[x * kSize + v] = columns[v * kSize + x];
    }
    for (int u = 0; u < kSize; ++u) {
        std::int32_t sums[kSize] = {};
        for (int x = 0; x < kSize; ++x) {
            const std::int32_t factor = codec::kTransform16[u * kRowStep][x];
            for (int v = 0; v < kSize; ++v) sums[v] += factor * turned[x * kSize + v];
        }
        for (int v = 0; v < kSize; ++v) {
            coefficients[v * kSize + u] = (sums[v] + (1 << (kSecondShift - 1))) >> kSecondShift;
        }
    }
}

}  // namespace

void forward_transform(const std::int16_t* residual, int size, std::int32_t* coefficients) {
    if (size == 8) {
        forward<8>(residual, coefficients);
    } else {
        forward<16>(residual, coefficients);
    }
}

bool quantise(const std::int32_t* coefficients, const QuantiserSettings& settings, const CostTable& costs,
              codec::Levels& levels, int& last) {
    namespace syntax = codec::syntax;
    const int size = settings.size;
    const std::uint8_t* const scan = syntax::scan_order(size);
    const int count = size * size;
    const float unit = size == 8 ? 16.0F : 8.0F;  // of the coefficients, in orthonormal ones
    const float step = static_cast<float>(codec::step_q4(settings.step)) / 16.0F * unit;
    const float inverse = 1 / step;
    const float scale = settings.weight / (unit * unit);

    int start = count - 1;
    while (start >= 0 && static_cast<float>(std::abs(coefficients[scan[start]])) * inverse < 0.5F) --start;
    if (start < 0) return false;

    // cost[i]: of coding place i; dropped[i]: of leaving it out; flagless[i]: of coding it as the last one.
    std::array<float, kLargest * kLargest> cost;
    std::array<float, kLargest * kLargest> dropped;
    std::array<float, kLargest * kLargest> flagless;
    for (int i = start; i >= 0; --i) {
        const int place = scan[i];
        const int u = place & (size - 1);
        const int v = place / size;
        const int coefficient = coefficients[place];
        const auto magnitude = static_cast<float>(std::abs(coefficient));
        const auto n = static_cast<std::size_t>(i);
        dropped[n] = scale * magnitude * magnitude;
        const int near = syntax::near_sum(levels, u, v);
        const auto bits_of = [&](int level, bool must_be) {
            Estimator estimator(costs);
            syntax::level(estimator, settings.kind, size, u, v, near, must_be, level);
            return estimator.bits();
        };
        const auto nearest = static_cast<int>(std::min(magnitude * inverse + 0.5F, 16000.0F));
        int best = 0;
        float best_cost = dropped[n] + settings.lambda * bits_of(0, false);
        flagless[n] = 1e30F;
        for (int level = nearest; level >= std::max(nearest - 1, 1); --level) {
            const float off = magnitude - static_cast<float>(level) * step;
            const float distortion = scale * off * off;
            const float total = distortion + settings.lambda * bits_of(level, false);
            if (total < best_cost) {
                best_cost = total;
                best = level;
                flagless[n] = distortion + settings.lambda * bits_of(level, true);
            }
        }
        cost[n] = best_cost;
        levels.at[v * codec::Levels::kStride + u] = static_cast<std::int16_t>(coefficient < 0 ? -best : best);
    }

    // Where to stop: everything above the last one is dropped.
    float below = 0;
    float all_dropped = 0;
    for (int i = 0; i <= start; ++i) all_dropped += dropped[static_cast<std::size_t>(i)];
    float best_total = all_dropped;
    float above = all_dropped;
    last = -1;
    for (int i = 0; i <= start; ++i) {
        const auto n = static_cast<std::size_t>(i);
        above -= dropped[n];
        if (flagless[n] < 1e30F) {
            Estimator estimator(costs);
            syntax::last_place(estimator, settings.kind, size, i);
            const float total = below + above + flagless[n] + settings.lambda * estimator.bits();
            if (total < best_total) {
                best_total = total;
                last = i;
            }
        }
        below += cost[n];
    }
    levels.used = 0;
    for (int i = 0; i <= start; ++i) {
        const int u = scan[i] & (size - 1);
        const int v = scan[i] / size;
        std::int16_t& level = levels.at[v * codec::Levels::kStride + u];
        if (i > last) level = 0;
        if (level != 0) levels.used = std::max(levels.used, std::max(u, v) + 1);
    }
    return last >= 0;
}

}  // namespace rs::encode
