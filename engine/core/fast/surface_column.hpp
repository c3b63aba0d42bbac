#pragma once
// Section 6 of engine/RECONSTRUCTION.md, "The surface between cells", precomputed for a whole view column. The
// interpolation between lines and along p is the same for all rows; only the interpolation between bands is left to
// each row.

#include "engine/core/definition/shape_cells.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rs::engine {

// Entry n is the surface between bands first_band + n and first_band + n + 1.
//
// If all four surrounding cells lie on one surface that both images show, `smooth` encodes its depth at h_part eighths
// between the bands: (8 * low + h_part * difference + 32) >> 6, with low = the lower kLowBits bits and difference = the
// upper 16, signed.
inline constexpr int kLowBits = 14;
inline constexpr std::int32_t kSurfaceSteps = 1 << 14;    // flag: 8 * low + h_part * difference is an index of `steps`
inline constexpr std::int32_t kSurfaceNothing = 1 << 15;  // flag: none of the four cells has a surface

inline constexpr std::size_t kSurfaceParts = 8;  // positions between two bands

// A surface in 16 bits: depth_q3 in the lower kDepthBits, lean above.
inline constexpr int kDepthBits = 11;
inline constexpr std::int32_t kNoSurface = 0xFFFF;

// The first and the last entry hold no surface, and there is none beyond them.
struct SurfaceColumn {
    std::int32_t first_band = 0;
    std::int32_t last = 0;       // index of the last entry
    std::int32_t nearest = 256;  // least depth of all surfaces, whole steps, rounded down; 256 without surfaces
    std::int32_t beyond = 0;     // march steps that begin at this depth or later meet no surface; at most 256
};

// Entries of several columns in shared memory.
struct SurfaceEntries {
    std::vector<std::int32_t> smooth;
    std::vector<std::int32_t> deepest;  // of the eight cells, whole steps; upper 16 bits: -1 if any has no surface
    // At most kSurfaceParts numbers per entry; those of a column begin at kSurfaceParts * its first entry. Each holds
    // SurfaceStack::first and SurfaceStack::behind in 16 bits each.
    std::vector<std::int32_t> steps;

    // Grows to at least `count` entries.
    void grow(std::size_t count) {
        smooth.resize(std::max(smooth.size(), count));
        deepest.resize(smooth.size());
        steps.resize(kSurfaceParts * smooth.size());
    }
};

// Largest number of entries of a column of `bands`; they are written in vectors of up to kSurfaceLanes.
inline constexpr std::size_t kSurfaceLanes = 32;
constexpr std::size_t surface_entries(int bands) {
    return static_cast<std::size_t>(bands) + 4 + kSurfaceLanes;
}

/// Builds a column from cells of `shape`. Writes up to surface_entries(bands) entries, from index `start` on.
SurfaceColumn build_surface_column(const CellColumns& columns, const ShapeMap& shape, std::size_t start,
                                   SurfaceEntries& entries);

/// Builds the column of a ray without a shape: one entry, which holds no surface.
SurfaceColumn build_empty_column(std::size_t start, SurfaceEntries& entries);

}  // namespace rs::engine
