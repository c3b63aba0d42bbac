// Compares the column kernels of depth estimation with plain implementations.

#include "encode/raymap/column_match.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

namespace rs::encode {
namespace {

std::vector<Rgba8> random_column(std::mt19937& random, int height) {
    std::vector<Rgba8> column(static_cast<std::size_t>(height));
    for (Rgba8& pixel : column) {
        const auto byte = [&] { return static_cast<std::uint8_t>(random() % 256); };
        pixel = {byte(), byte(), byte(), random() % 4 == 0 ? std::uint8_t{0} : byte()};
    }
    return column;
}

TEST(ColumnMatch, CostsAreMeansOfDifferences) {
    std::mt19937 random(5);
    for (int round = 0; round < 300; ++round) {
        const int rows = 1 + static_cast<int>(random() % 150);
        const int height = 1 + static_cast<int>(random() % 150);
        const std::vector<Rgba8> own = random_column(random, rows);
        const std::vector<Rgba8> first = random_column(random, height);
        std::vector<Rgba8> second = random_column(random, height);
        if (round % 2 == 0) second = first;
        const ColumnMatch match{.own = own.data(),
                                .first = first.data(),
                                .second = second.data(),
                                .part = static_cast<int>(random() % 32),
                                .rows = rows,
                                .height = height,
                                .position_q16 = static_cast<std::int32_t>(random() % (40 << 16)) - (20 << 16),
                                .step_q16 = static_cast<std::int32_t>(random() % (3 << 16))};
        std::vector<std::uint8_t> costs(own.size());
        match_column(match, costs.data());
        for (int n = 0; n < rows; ++n) {
            const int row = (match.position_q16 + n * match.step_q16) >> 16;
            int wanted = kUnknownMatch;
            const Rgba8 mine = own[static_cast<std::size_t>(n)];
            if (mine.a != 0 && row >= 0 && row < height) {
                const Rgba8 a = first[static_cast<std::size_t>(row)];
                const Rgba8 b = second[static_cast<std::size_t>(row)];
                const auto between = [&](int one, int other) { return one * (32 - match.part) + other * match.part; };
                const int sum = std::abs(32 * mine.r - between(a.r, b.r)) + std::abs(32 * mine.g - between(a.g, b.g)) +
                                std::abs(32 * mine.b - between(a.b, b.b));
                wanted = between(a.a, b.a) < 128 * 32 ? kOutsideMatch : std::min(sum / 96, kMaxCost);
            }
            ASSERT_EQ(costs[static_cast<std::size_t>(n)], wanted) << round << ", " << n;
        }
    }
}

TEST(ColumnMatch, DepthsCostWhatTheyAreAway) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> deep(-1, 1);
    int nearer = 0;
    for (int round = 0; round < 300; ++round) {
        const int rows = 1 + static_cast<int>(random() % 150);
        const int height = 1 + static_cast<int>(random() % 150);
        std::vector<float> depths(static_cast<std::size_t>(height));
        for (float& depth : depths) depth = random() % 5 == 0 ? std::numeric_limits<float>::quiet_NaN() : deep(random);
        const ColumnDepths found{.depths = depths.data(),
                                 .depth = deep(random),
                                 .cost_per_unit = 100,
                                 .rows = rows,
                                 .height = height,
                                 .position_q16 = static_cast<std::int32_t>(random() % (40 << 16)) - (20 << 16),
                                 .step_q16 = static_cast<std::int32_t>(random() % (3 << 16))};
        std::vector<std::uint8_t> before(static_cast<std::size_t>(rows));
        for (std::uint8_t& cost : before) cost = static_cast<std::uint8_t>(random() % 256);
        std::vector<std::uint8_t> after = before;
        compare_depth_column(found, after.data());
        for (int n = 0; n < rows; ++n) {
            const auto at = static_cast<std::size_t>(n);
            const int row = (found.position_q16 + n * found.step_q16) >> 16;
            int wanted = before[at];
            if (row >= 0 && row < height && !std::isnan(depths[static_cast<std::size_t>(row)])) {
                const float away = std::abs(depths[static_cast<std::size_t>(row)] - found.depth) * found.cost_per_unit;
                wanted = std::min(wanted, std::min(static_cast<int>(away), kMaxCost));
            }
            nearer += wanted < before[at] ? 1 : 0;
            ASSERT_EQ(after[at], wanted) << round << ", " << n;
        }
    }
    EXPECT_GT(nearer, 1000);
}

// Merged cost of one kind of neighbours; none: -1, outside: -2.
int of_kind(const std::vector<int>& costs) {
    std::vector<int> known;
    bool outside = false;
    for (const int cost : costs) {
        if (cost == kUnknownMatch) continue;
        outside = outside || cost == kOutsideMatch;
        known.push_back(cost);
    }
    if (outside) return -2;
    if (known.empty()) return -1;
    const int best = *std::min_element(known.begin(), known.end());
    const int worst = *std::max_element(known.begin(), known.end());
    return (3 * best + std::min(worst, best + 20)) / 4;
}

TEST(ColumnMatch, MergesWhatNeighboursSay) {
    std::mt19937 random(6);
    for (int round = 0; round < 300; ++round) {
        const int rows = 1 + static_cast<int>(random() % 150);
        const int beside = static_cast<int>(random() % 3);
        const int across = static_cast<int>(random() % 3);
        std::vector<std::uint8_t> costs(static_cast<std::size_t>(rows * (beside + across)));
        for (std::uint8_t& cost : costs) {
            const unsigned kind = random() % 8;
            cost = static_cast<std::uint8_t>(kind == 0   ? kUnknownMatch
                                             : kind == 1 ? kOutsideMatch
                                                         : random() % (kMaxCost + 1));
        }
        std::vector<std::uint8_t> merged(static_cast<std::size_t>(rows));
        merge_matches(costs.data(), rows, beside, across, merged.data());
        for (int row = 0; row < rows; ++row) {
            std::vector<int> kinds[2];
            for (int n = 0; n < beside + across; ++n) {
                kinds[n < beside ? 0 : 1].push_back(costs[static_cast<std::size_t>(n * rows + row)]);
            }
            const int a = of_kind(kinds[0]);
            const int b = of_kind(kinds[1]);
            const int wanted = a == -2 || b == -2   ? kOutsideCost
                               : a == -1 && b == -1 ? kMaxCost / 2
                               : a == -1            ? b
                               : b == -1            ? a
                                                    : (a + b) / 2;
            ASSERT_EQ(merged[static_cast<std::size_t>(row)], wanted) << round << ", " << row;
        }
    }
}

}  // namespace
}  // namespace rs::encode
