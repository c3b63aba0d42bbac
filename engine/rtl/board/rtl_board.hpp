#pragma once
// The board `prototype-2000` in RTL, verilated, as seen by its driver: objects and rendering cycles in, images out. The
// counterpart of model::Board.

#include "engine/model/board.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace rs::engine::rtl {

class RtlBoard {
public:
    virtual ~RtlBoard() = default;

    /// Writes the object into memory without a clock. Fails as model::Board::place(). Returns its slot.
    virtual Result<int> place(const RaySpaceObject& object) = 0;
    /// Starts loading the object from the board's disk. Returns its slot, which is valid after finish_loads().
    virtual Result<int> start_load(const RaySpaceObject& object) = 0;
    /// Runs until all objects are loaded. Fails if the disk delivered no data before its timeout.
    virtual Status finish_loads() = 0;
    /// Renders the cycles in order, two in flight, until all images are in host memory. Fails if the board refuses a
    /// cycle, breaks a timing rule of the SDRAM, or makes no progress.
    virtual Result<std::vector<model::RenderedCycle>> render(
        const std::vector<std::vector<model::BoardView>>& cycles) = 0;
    /// Writes a waveform of all signals (VCD) from now on, for at most `max_cycles` board cycles.
    virtual Status trace(const std::filesystem::path& path, std::uint64_t max_cycles) = 0;
    [[nodiscard]] virtual std::uint64_t board_cycles() const = 0;
};

/// Fails if this build has no verilated board, or if `config` differs from prototype-2000 in more than the faults of
/// bus and disk and the times of the drive; the message names the remedy.
Result<std::unique_ptr<RtlBoard>> make_rtl_board(const model::BoardConfig& config);

}  // namespace rs::engine::rtl
