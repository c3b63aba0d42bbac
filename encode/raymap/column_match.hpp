#pragma once
// Inner loops of the matching costs along a column, compiled for each SIMD target of Highway and dispatched at run
// time. All targets give the same integers. Thread-safe.

#include "rayspace/image/image.hpp"

#include <cstddef>
#include <cstdint>

namespace rs::encode {

inline constexpr int kMaxCost = 60;
inline constexpr int kOutsideCost = 2 * kMaxCost;

/// The cost of a pixel at a depth against one neighbor is 0 .. kMaxCost, or one of these.
inline constexpr std::uint8_t kUnknownMatch = 255;  // the pixel is transparent, or the point outside of the frame
inline constexpr std::uint8_t kOutsideMatch = 254;  // the neighbor is transparent there

/// Pixels of one column and the projections of their points into a neighbor.
struct ColumnMatch {
    const Rgba8* own = nullptr;    // `rows` pixels
    const Rgba8* first = nullptr;  // the neighbor's two columns to interpolate between, `height` pixels each
    const Rgba8* second = nullptr;
    int part = 0;  // interpolation weight of the second column, 1/32
    int rows = 0;
    int height = 0;
    std::int32_t position_q16 = 0;  // neighbor's row of the first pixel, and step per pixel
    std::int32_t step_q16 = 0;
};

/// Depths along a column of a neighbor, and the projections of points at one depth.
struct ColumnDepths {
    const float* depths = nullptr;  // `height` depths, NaN where unknown
    float depth = 0;                // of the points, along the neighbor's ray
    float cost_per_unit = 1;
    int rows = 0;
    int height = 0;
    std::int32_t position_q16 = 0;  // as above
    std::int32_t step_q16 = 0;
};

/// Writes for each row the mean absolute difference of R, G and B, at most kMaxCost, or kUnknownMatch or
/// kOutsideMatch.
void match_column(const ColumnMatch& match, std::uint8_t* costs);

/// Lowers least[row] to the distance between the depth and the neighbor's, times cost_per_unit, rounded down, at most
/// kMaxCost.
void compare_depth_column(const ColumnDepths& found, std::uint8_t* least);

/// Merges the costs of several neighbors: costs[n * rows + row], first of `beside` neighbors, then of `across`, into
/// merged[row]. Within a kind the best cost has weight 3/4 and the worst, limited to 20 above it, 1/4; the result is
/// the mean of both kinds, and kOutsideCost where any neighbor has kOutsideMatch.
void merge_matches(const std::uint8_t* costs, int rows, int beside, int across, std::uint8_t* merged);

}  // namespace rs::encode
