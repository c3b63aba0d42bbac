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
// Where all four cells around it lie on one surface, `smooth` alone gives how deep that is at h_part eighths of the
// way: (8 * low + h_part * difference + 32) >> 6, with low = its lower kLowBits bits and difference = its upper 16,
// signed; both images show it.
inline constexpr int kLowBits = 14;
inline constexpr std::int32_t kSurfaceSteps = 1 << 14;    // ... or the cells differ, and 8 * low + h_part * difference
                                                          // is a place in `steps`
inline constexpr std::int32_t kSurfaceNothing = 1 << 15;  // ... or none of the four has a surface

inline constexpr std::size_t kSurfaceParts = 8;  // of the way from band to band

// A surface in 16 bits: depth_q3 below its lean.
inline constexpr int kDepthBits = 11;
inline constexpr std::int32_t kNoSurface = 0xFFFF;

// The first and the last entry hold no surface; nor does any place beyond them.
struct SurfaceColumn {
    std::int32_t first_band = 0;
    std::int32_t last = 0;       // number of the last entry
    std::int32_t nearest = 256;  // least depth of all surfaces, whole steps, rounded down; 256 where there are none
    std::int32_t beyond = 0;     // a march that begins a step here or later meets none; 256 at most
};

// What each entry holds, in memory that columns share.
struct SurfaceEntries {
    std::vector<std::int32_t> smooth;
    std::vector<std::int32_t> deepest;  // of the eight cells, whole steps; upper 16 bits: -1 where one has no surface
    // kSurfaceParts numbers for each entry at most, those of a column from kSurfaceParts * its first entry on: the
    // first surface of a SurfaceStack and the one behind it, 16 bits each.
    std::vector<std::int32_t> steps;

    void hold(std::size_t count) {
        smooth.resize(std::max(smooth.size(), count));
        deepest.resize(smooth.size());
        steps.resize(kSurfaceParts * smooth.size());
    }
};

// Entries that a column of `bands` takes at most; they are written in vectors of up to kSurfaceLanes.
inline constexpr std::size_t kSurfaceLanes = 32;
constexpr std::size_t surface_entries(int bands) {
    return static_cast<std::size_t>(bands) + 4 + kSurfaceLanes;
}

// `columns` has the shape `shape`. Writes up to surface_entries(bands) numbers each to smooth and deepest + start.
SurfaceColumn lay_surfaces(const CellColumns& columns, const ShapeMap& shape, std::size_t start,
                           SurfaceEntries& entries);

// The column of a ray without a shape: one entry, which holds no surface.
SurfaceColumn lay_nothing(std::size_t start, SurfaceEntries& entries);

}  // namespace rs::engine
