#pragma once
// Codes the contents of three chunks as bytes that compress well (encode/FORMAT.md): lines of a ring, cells of an RS
// map, and cells of a shape map.

#include "rayspace/api/types/shape_map.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// Codes the lines of a ring as a byte plane for compression. Over the reference planes, two of a view's four numbers
// are constant and two are sinusoidal, up to rounding; only the residuals are stored. encode/FORMAT.md, section "RING",
// "Coded lines".
namespace rs::line_coding {

inline constexpr std::size_t kBytesPerLine = 16;

/// Encodes the residuals, kBytesPerLine per line, without loss for any values. lines[n * planes + k] is line k of the
/// ring's n-th view; planes kMinPlanes..kMaxPlanes.
std::vector<std::uint8_t> encode_residuals(std::span<const CapturedLine> lines, int planes);

/// Decodes the residuals; any bytes, kBytesPerLine per line, are valid.
void decode_residuals(std::span<const std::uint8_t> plane, int planes, std::span<CapturedLine> lines);

}  // namespace rs::line_coding

// Codes the cells of a ring's RS map as runs along u, and the runs as residuals that are mostly 0, for compression:
// rows of neighbouring x have nearly the same views and run lengths. encode/FORMAT.md, section "RMAP".
namespace rs::map_coding {

/// Runs row by row; the runs of a row cover it.
struct Runs {
    std::vector<std::uint16_t> counts;   // [row] number of runs
    std::vector<std::uint16_t> views;    // [run]
    std::vector<std::uint16_t> lengths;  // [run], cells
};

/// The size of the residuals: 2 bytes per row, 4 per run.
std::uint64_t residual_bytes(std::uint64_t rows, std::uint64_t runs);

/// Run-length encodes whole rows of u_cells cells, 1 .. 65535.
Runs encode_runs(std::span<const std::uint16_t> cells, int u_cells);
std::vector<std::uint8_t> encode_residuals(const Runs& runs);

/// The inverse of encode_residuals; any residual_bytes() bytes are valid.
Runs decode_run_residuals(std::span<const std::uint8_t> plane, std::size_t rows, std::size_t runs);

/// The inverse of encode_runs(). Fails if the runs do not cover each row of u_cells exactly, or a length is 0.
Status decode_runs(const Runs& runs, int u_cells, std::span<std::uint16_t> cells);

}  // namespace rs::map_coding

// Entropy coding of a shape map's cells with a binary arithmetic coder: encode/FORMAT.md, section "shap", "Cells".
namespace rs::shape_coding {

/// Encodes the cells of a valid map. Deterministic.
std::vector<std::byte> encode_cells(const ShapeMap& shape);

/// Decodes into shape.cells, which has its size. Any bytes decode to valid cells.
void decode_cells(std::span<const std::byte> bytes, ShapeMap& shape);

/// Replaces each depth by its prediction, which takes almost no bits, if that is at most `tolerance` steps away.
void snap_depths(ShapeMap& shape, int tolerance);

}  // namespace rs::shape_coding
