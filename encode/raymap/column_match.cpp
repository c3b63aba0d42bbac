#include "encode/raymap/column_match.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encode/raymap/column_match.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>

// Plain loops without branches: the compiler makes vectors of them, as long as each target has.
HWY_BEFORE_NAMESPACE();
namespace rs::encode::HWY_NAMESPACE {

constexpr int kRun = 64;  // rows that are worked on at once

// Up to kRun rows from `begin` on.
HWY_INLINE void match_run(const ColumnMatch& match, int begin, int count, std::uint8_t* costs) {
    Rgba8 a[kRun];
    Rgba8 b[kRun];
    std::uint8_t in_frame[kRun];
    for (int n = 0; n < count; ++n) {
        const int row = (match.position_q16 + (begin + n) * match.step_q16) >> 16;
        in_frame[n] = row >= 0 && row < match.height ? 255 : 0;
        const int clamped = std::clamp(row, 0, match.height - 1);
        a[n] = match.first[clamped];
        b[n] = match.second[clamped];
    }
    const auto of_second = static_cast<std::int16_t>(match.part);
    const auto of_first = static_cast<std::int16_t>(32 - match.part);
    const Rgba8* const own = match.own + begin;
    for (int n = 0; n < count; ++n) {
        const auto difference = [&](std::uint8_t mine, std::uint8_t one, std::uint8_t other) {
            return std::abs(mine * 32 - one * of_first - other * of_second);
        };
        const int sum = difference(own[n].r, a[n].r, b[n].r) + difference(own[n].g, a[n].g, b[n].g) +
                        difference(own[n].b, a[n].b, b[n].b);
        const int cost = std::min((sum * 43691) >> 22, kMostCost);  // sum / 96, exact up to 3 * 32 * 255
        const bool outside = a[n].a * of_first + b[n].a * of_second < 128 * 32;
        const int known = outside ? kOutsideMatch : cost;
        const bool none = own[n].a == 0 || in_frame[n] == 0;
        costs[n] = static_cast<std::uint8_t>(none ? kUnknownMatch : known);
    }
}

void match_all(const ColumnMatch& match, std::uint8_t* costs) {
    for (int begin = 0; begin < match.rows; begin += kRun) {
        match_run(match, begin, std::min(kRun, match.rows - begin), costs + begin);
    }
}

// What neighbours of one kind say of a run of rows.
struct KindRun {
    std::uint8_t cost[kRun];
    std::uint8_t known[kRun];
    std::uint8_t outside[kRun];
};

HWY_INLINE void weigh_kind(const std::uint8_t* costs, int rows, int neighbours, int count, KindRun& kind) {
    std::uint8_t best[kRun];
    std::uint8_t worst[kRun];
    for (int n = 0; n < kRun; ++n) {
        best[n] = kMostCost;
        worst[n] = 0;
        kind.known[n] = 0;
        kind.outside[n] = 0;
    }
    for (int neighbour = 0; neighbour < neighbours; ++neighbour) {
        const std::uint8_t* const of_one = costs + static_cast<std::ptrdiff_t>(neighbour) * rows;
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
        weigh_kind(costs + begin, rows, beside, count, a);
        weigh_kind(costs + static_cast<std::ptrdiff_t>(beside) * rows + begin, rows, across, count, b);
        for (int n = 0; n < count; ++n) {
            const int both = (a.cost[n] + b.cost[n]) / 2;
            const int of_a = a.known[n] != 0 ? a.cost[n] : kMostCost / 2;
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
HWY_EXPORT(merge_all);

void match_column(const ColumnMatch& match, std::uint8_t* costs) {
    HWY_DYNAMIC_DISPATCH(match_all)(match, costs);
}

void merge_matches(const std::uint8_t* costs, int rows, int beside, int across, std::uint8_t* merged) {
    HWY_DYNAMIC_DISPATCH(merge_all)(costs, rows, beside, across, merged);
}

}  // namespace rs::encode
#endif  // HWY_ONCE
