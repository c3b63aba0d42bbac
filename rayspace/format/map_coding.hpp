#pragma once
// Codes the cells of a ring's RS map as runs along u, and the runs as residuals that are mostly 0, for compression:
// rows of neighbouring x have nearly the same views and run lengths. encode/FORMAT.md, section "RMAP".

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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

/// The inverse of runs_of. Fails if the runs do not cover each row of u_cells exactly, or a length is 0.
Status decode_runs(const Runs& runs, int u_cells, std::span<std::uint16_t> cells);

}  // namespace rs::map_coding
