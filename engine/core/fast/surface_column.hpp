#pragma once
// Section 6 of engine/RECONSTRUCTION.md, "The surface between cells", prepared for a whole view column: between the two
// lines and in p everything is the same for all rows, so only the place between two bands is left to each of them.

#include "engine/core/definition/shape_cells.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rs::engine {

// Entry n stands for the surface between bands first_band + n and first_band + n + 1.
//
// Where all four cells around it lie on one surface, `smooth` alone says how deep that is at h_part eighths of the way:
// (8 * low + h_part * difference + 32) >> 6, with low = its lower kLowBits bits and difference = its upper 16, signed.
inline constexpr int kLowBits = 14;
inline constexpr std::int32_t kSurfaceSteps = 1 << 14;    // ... or the cells differ: see `pairs` of bands n and n + 1
inline constexpr std::int32_t kSurfaceNothing = 1 << 15;  // ... or none of the four has a surface

// The first and the last entry say nothing; so does every place beyond them.
struct SurfaceColumn {
    std::int32_t first_band = 0;
    std::int32_t last = 0;       // number of the last entry
    std::int32_t nearest = 256;  // least depth of all surfaces, whole steps, rounded down; 256 where there are none
    std::int32_t beyond = 0;     // one more than the greatest back, 0 where there are none
};

// Three numbers for each entry, in memory that columns share.
struct SurfaceEntries {
    std::vector<std::int32_t> smooth;
    std::vector<std::int32_t> pairs;  // of band first_band + n: depth_q3 of the two p, 16 bits each, -1: nothing
    std::vector<std::int32_t> backs;  // the greatest of the four; upper 16: depth_q3 of SurfaceStack::farthest, or -1

    void hold(std::size_t count) {
        for (auto* const numbers : {&smooth, &pairs, &backs}) numbers->resize(std::max(numbers->size(), count));
    }
};

// Entries that a column of `bands` takes at most; they are written in vectors of up to kSurfaceLanes.
inline constexpr std::size_t kSurfaceLanes = 32;
constexpr std::size_t surface_entries(int bands) {
    return static_cast<std::size_t>(bands) + 4 + kSurfaceLanes;
}

// `columns` has a shape. Writes up to surface_entries(bands) numbers each to smooth, pairs and backs + start.
SurfaceColumn lay_surfaces(const CellColumns& columns, int bands, int jump, std::size_t start, SurfaceEntries& entries);

// The column of a ray without a shape: one entry, which says nothing.
SurfaceColumn lay_nothing(std::size_t start, SurfaceEntries& entries);

}  // namespace rs::engine
