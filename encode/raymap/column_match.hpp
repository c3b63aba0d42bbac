#pragma once
// The loops along a column that the search for depth spends its time in, compiled for every SIMD target that
// Highway knows and chosen at run time; all give the same integers. Thread-safe.

#include "rayspace/image/image.hpp"

#include <cstddef>
#include <cstdint>

namespace rs::encode {

inline constexpr int kMostCost = 60;
inline constexpr int kOutsideCost = 2 * kMostCost;

// What one neighbour gives for a pixel at a depth: a cost 0 .. kMostCost, or one of these.
inline constexpr std::uint8_t kUnknownMatch = 255;  // the pixel is not of the object, or the point not in the frame
inline constexpr std::uint8_t kOutsideMatch = 254;  // the point is not of the neighbour's object

// Pixels of one column and where their points lie in a neighbour.
struct ColumnMatch {
    const Rgba8* own = nullptr;    // `rows` pixels
    const Rgba8* first = nullptr;  // the two columns of the neighbour that the points lie between: `height` pixels each
    const Rgba8* second = nullptr;
    int part = 0;  // of the way from the first to the second, 1/32
    int rows = 0;
    int height = 0;
    std::int32_t position_q16 = 0;  // row of the neighbour for the first pixel, and the step to the next one's
    std::int32_t step_q16 = 0;
};

// What a neighbour was found to show along one of its columns, and a depth of the points whose rows these are.
struct ColumnDepths {
    const float* depths = nullptr;  // `height`, NaN where nothing was found
    float depth = 0;                // along the neighbour's rays
    float cost_per_unit = 1;
    int rows = 0;
    int height = 0;
    std::int32_t position_q16 = 0;  // as above
    std::int32_t step_q16 = 0;
};

// The mean absolute difference of R, G and B, at most kMostCost, or one of the two above, for each row.
void match_column(const ColumnMatch& match, std::uint8_t* costs);

// least[row] becomes what the depth is away from the one found there, times cost_per_unit, rounded down, at most
// kMostCost, where that is less than it was.
void approach_depths(const ColumnDepths& found, std::uint8_t* least);

// costs[n * rows + row] of `beside` neighbours of the one kind and then `across` of the other -> merged[row].
// Of a kind the best counts three quarters and the worst, at most 20 more, a quarter; of both kinds the mean. Where a
// neighbour finds that the point is outside: kOutsideCost.
void merge_matches(const std::uint8_t* costs, int rows, int beside, int across, std::uint8_t* merged);

}  // namespace rs::encode
