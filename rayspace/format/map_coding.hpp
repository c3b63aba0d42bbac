#pragma once
// The cells of a ring's RS map as runs along u, and those as numbers that are mostly 0, which is what the file
// compresses: rows of neighbouring x name nearly the same views over nearly the same lengths.
// encode/FORMAT.md, section "RMAP".

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::map_coding {

// Row by row; a row's runs cover it.
struct Runs {
    std::vector<std::uint16_t> counts;   // of each row
    std::vector<std::uint16_t> views;    // of each run
    std::vector<std::uint16_t> lengths;  // of each run, cells
};

// 2 bytes per row, 4 per run.
std::uint64_t residual_bytes(std::uint64_t rows, std::uint64_t runs);

// `cells` holds whole rows of u_cells, 1 .. 65535.
Runs runs_of(std::span<const std::uint16_t> cells, int u_cells);
std::vector<std::uint8_t> residual_plane(const Runs& runs);

// The reverse of residual_plane: any bytes, residual_bytes() of them, are those of some runs.
Runs runs_of_residuals(std::span<const std::uint8_t> plane, std::size_t rows, std::size_t runs);

// The reverse of runs_of. Refuses runs that do not cover each row of u_cells exactly, and of length 0.
Status put_runs(const Runs& runs, int u_cells, std::span<std::uint16_t> cells);

}  // namespace rs::map_coding
