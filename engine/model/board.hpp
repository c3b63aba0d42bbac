#pragma once
// The board as seen by its driver: objects and rendering cycles in, images in host memory out, with cycle statistics.
// Drives the clock of board_top.
//
// Not thread-safe. The same calls give the same bits and the same cycles.

#include "engine/model/board_top.hpp"
#include "engine/model/layout/object_slots.hpp"
#include "rayspace/api/types/executor.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::engine::model {

// Cycle counts of every block up to a point in time.
struct Snapshot {
    std::uint64_t board_cycles = 0;
    std::uint64_t pci_cycles = 0;
    std::vector<ActivityCounts> blocks;  // in the order of Board::blocks()
};

struct RenderedCycle {
    std::uint64_t started = 0;   // board cycle in which the first view was begun
    std::uint64_t rendered = 0;  // the last word was in the image buffer
    std::uint64_t arrived = 0;   // the last word was in host memory
    std::vector<Image<Rgba8>> images;
    [[nodiscard]] std::uint64_t render_cycles() const { return rendered - started; }
};

struct BoardRun {
    std::vector<RenderedCycle> cycles;
    Snapshot begin;
    Snapshot first_rendered;  // first cycle rendered; its transfer can begin
    Snapshot rendered;        // last cycle rendered
    Snapshot end;             // images of the last cycle arrived
};

// Image of a view from the words that the board wrote into host memory.
Image<Rgba8> unpack_host_image(const HostImage& words, const BoardView& view);

class Board {
public:
    // `shuffle_seed` other than 0: blocks are ticked in random order (for tests; results must not change).
    explicit Board(const BoardConfig& config, std::uint64_t shuffle_seed = 0);

    // Writes the object into memory without a clock, as if loaded earlier. Fails if the board cannot render it
    // (drawable), or if slots or memory are full. Returns its slot.
    Result<int> place(const RaySpaceObject& object);

    // Starts loading the object from the board's disk; the slot becomes valid when finish_loads() succeeds.
    Result<int> start_load(const RaySpaceObject& object);

    // Runs until the disk controller is idle. Fails with the slot of a load that failed; that slot is free again.
    Status finish_loads();

    // Frees the slot. Fails if it is empty, still loading, or used by a submitted cycle that is not yet drawn.
    Status evict(int slot);

    // Registers of a view of the object in `slot`; fails for a view that is not upright.
    Result<BoardView> view(int slot, const engine::ViewRegisters& registers) const;

    // Submits a cycle without checking the state of the board; top().render_control.refusals() lists refusals. render()
    // below checks it.
    void submit(std::vector<BoardView> views);

    // Renders the cycles in order, two in flight, until all images are in host memory. Fails if the board refuses a
    // cycle (bad registers) or makes no progress.
    Result<BoardRun> render(const std::vector<std::vector<BoardView>>& cycles);

    [[nodiscard]] BoardTop& top() { return *top_; }
    [[nodiscard]] const BoardTop& top() const { return *top_; }
    [[nodiscard]] const MemoryMap& memory_map() const { return slots_.memory_map(); }
    [[nodiscard]] std::vector<const Block*> blocks() const;
    [[nodiscard]] Snapshot snapshot() const;

private:
    [[nodiscard]] RenderedCycle collect(std::uint64_t cycle);

    std::unique_ptr<BoardTop> top_;
    ObjectSlots slots_;
    std::size_t collected_loads_ = 0;
};

// Capabilities of a simulated board.
ExecutorTraits board_traits(const BoardConfig& config);

// Simulated board as an executor with the interface and the results of the hardware (simulated_board.cpp).
// Objects are loaded from the board's disk in simulated time, or with `instant_loads` placed into memory at once.
std::unique_ptr<Executor> make_simulated_board(const BoardConfig& config, bool instant_loads = false);

}  // namespace rs::engine::model
