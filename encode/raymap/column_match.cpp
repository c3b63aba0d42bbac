#include "encode/raymap/column_match.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encode/raymap/column_match.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>

// Plain loops without branches, for auto-vectorization with each target's vector length.
HWY_BEFORE_NAMESPACE();
namespace rs::encode::HWY_NAMESPACE {

constexpr int kRun = 64;  // rows per block

HWY_INLINE int channel(std::uint32_t pixel, int shift) {
    return static_cast<int>((pixel >> shift) & 255U);
}

// `count` <= kRun rows from `begin`.
HWY_INLINE void match_run(const ColumnMatch& match, int begin, int count, std::uint8_t* costs) {
    // Pixels as 32-bit lanes, R in the lowest byte.
    std::uint32_t own[kRun];
    std::uint32_t first[kRun];
    std::uint32_t second[kRun];
    std::int32_t row[kRun];
    std::memcpy(own, match.own + begin, static_cast<std::size_t>(count) * sizeof own[0]);
    for (int n = 0; n < count; ++n) row[n] = (match.position_q16 + (begin + n) * match.step_q16) >> 16;
    for (int n = 0; n < count; ++n) {
        const int clamped = std::clamp(row[n], 0, match.height - 1);
        std::memcpy(first + n, match.first + clamped, sizeof first[0]);
        std::memcpy(second + n, match.second + clamped, sizeof second[0]);
    }
    const int part = match.part;
    const int height = match.height;
    for (int n = 0; n < count; ++n) {
        // Interpolated between the two columns, in 1/32.
        const auto between = [&](int shift) {
            const int one = channel(first[n], shift);
            return 32 * one + part * (channel(second[n], shift) - one);
        };
        const auto difference = [&](int shift) { return std::abs(32 * channel(own[n], shift) - between(shift)); };
        const int sum = difference(0) + difference(8) + difference(16);
        const int cost = std::min((sum * 43691) >> 22, kMaxCost);  // sum / 96, exact up to 3 * 32 * 255
        const int known = between(24) < 128 * 32 ? kOutsideMatch : cost;
        const bool none = (own[n] >> 24) == 0 || row[n] < 0 || row[n] >= height;
        costs[n] = static_cast<std::uint8_t>(none ? kUnknownMatch : known);
    }
}

void match_all(const ColumnMatch& match, std::uint8_t* costs) {
    for (int begin = 0; begin < match.rows; begin += kRun) {
        match_run(match, begin, std::min(kRun, match.rows - begin), costs + begin);
    }
}

HWY_INLINE void compare_depth_run(const ColumnDepths& found, int begin, int count, std::uint8_t* least) {
    float there[kRun];
    std::int32_t row[kRun];
    for (int n = 0; n < count; ++n) row[n] = (found.position_q16 + (begin + n) * found.step_q16) >> 16;
    for (int n = 0; n < count; ++n) there[n] = found.depths[std::clamp(row[n], 0, found.height - 1)];
    const int height = found.height;
    const float depth = found.depth;
    const float cost_per_unit = found.cost_per_unit;
    for (int n = 0; n < count; ++n) {
        const float away = std::abs(there[n] - depth) * cost_per_unit;
        const int cost = away < static_cast<float>(kMaxCost) ? static_cast<int>(away) : kMaxCost;
        const bool none = std::isnan(there[n]) || row[n] < 0 || row[n] >= height;
        least[n] = static_cast<std::uint8_t>(std::min(none ? kUnknownMatch : cost, static_cast<int>(least[n])));
    }
}

void compare_all_depths(const ColumnDepths& found, std::uint8_t* least) {
    for (int begin = 0; begin < found.rows; begin += kRun) {
        compare_depth_run(found, begin, std::min(kRun, found.rows - begin), least + begin);
    }
}

// Merged costs of the neighbors of one kind for a block of rows.
struct KindRun {
    std::uint8_t cost[kRun];
    std::uint8_t known[kRun];
    std::uint8_t outside[kRun];
};

// `first` is the index of the first neighbour's cost; there may be no neighbours and no costs.
HWY_INLINE void weigh_kind(const std::uint8_t* costs, std::ptrdiff_t first, int rows, int neighbours, int count,
                           KindRun& kind) {
    std::uint8_t best[kRun];
    std::uint8_t worst[kRun];
    for (int n = 0; n < kRun; ++n) {
        best[n] = kMaxCost;
        worst[n] = 0;
        kind.known[n] = 0;
        kind.outside[n] = 0;
    }
    for (int neighbour = 0; neighbour < neighbours; ++neighbour) {
        const std::uint8_t* const of_one = costs + first + static_cast<std::ptrdiff_t>(neighbour) * rows;
        for (int n = 0; n < count; ++n) {
            const std::uint8_t cost = of_one[n];
            const auto known = static_cast<std::uint8_t>(cost != kUnknownMatch ? 1 : 0);
            kind.known[n] |= known;
            kind.outside[n] |= static_cast<std::uint8_t>(cost == kOutsideMatch ? 1 : 0);
            best[n] = std::min(best[n], cost);
            worst[n] = std::max(worst[n], known != 0 ? cost : worst[n]);
        }
    }
    for (int n = 0; n < count; ++n) {
        const int most = std::min(static_cast<int>(worst[n]), best[n] + 20);
        kind.cost[n] = static_cast<std::uint8_t>((3 * best[n] + most) / 4);
    }
}

void merge_all(const std::uint8_t* costs, int rows, int beside, int across, std::uint8_t* merged) {
    for (int begin = 0; begin < rows; begin += kRun) {
        const int count = std::min(kRun, rows - begin);
        KindRun a;
        KindRun b;
        weigh_kind(costs, begin, rows, beside, count, a);
        weigh_kind(costs, static_cast<std::ptrdiff_t>(beside) * rows + begin, rows, across, count, b);
        for (int n = 0; n < count; ++n) {
            const int both = (a.cost[n] + b.cost[n]) / 2;
            const int of_a = a.known[n] != 0 ? a.cost[n] : kMaxCost / 2;
            const int of_b = a.known[n] != 0 ? both : b.cost[n];
            const int cost = b.known[n] != 0 ? of_b : of_a;
            const bool outside = (a.outside[n] | b.outside[n]) != 0;
            merged[begin + n] = static_cast<std::uint8_t>(outside ? kOutsideCost : cost);
        }
    }
}

}  // namespace rs::encode::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rs::encode {

HWY_EXPORT(match_all);
HWY_EXPORT(compare_all_depths);
HWY_EXPORT(merge_all);

void match_column(const ColumnMatch& match, std::uint8_t* costs) {
    HWY_DYNAMIC_DISPATCH(match_all)(match, costs);
}

void compare_depth_column(const ColumnDepths& found, std::uint8_t* least) {
    HWY_DYNAMIC_DISPATCH(compare_all_depths)(found, least);
}

void merge_matches(const std::uint8_t* costs, int rows, int beside, int across, std::uint8_t* merged) {
    HWY_DYNAMIC_DISPATCH(merge_all)(costs, rows, beside, across, merged);
}

}  // namespace rs::encode
#endif  // HWY_ONCE
