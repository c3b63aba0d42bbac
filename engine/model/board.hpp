#pragma once
// The board as its driver sees it: objects in, rendering cycles in, images in the host's memory out, and where the
// cycles went. Drives the clock of board_top.
//
// Not thread-safe. The same calls give the same bits and the same cycles.

#include "engine/model/board_top.hpp"
#include "engine/model/layout/memory_map.hpp"
#include "engine/model/layout/object_image.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::engine::model {

// Where the cycles of every block went up to a moment.
struct Snapshot {
    std::uint64_t board_cycles = 0;
    std::uint64_t pci_cycles = 0;
    std::vector<ActivityCounts> blocks;  // in the order of Board::blocks()
};

struct RenderedCycle {
    std::uint64_t started = 0;   // board cycles: the first view was begun
    std::uint64_t rendered = 0;  // the last word was in the image buffer
    std::uint64_t arrived = 0;   // and in the host's memory
    std::vector<Image<Rgba8>> images;
    [[nodiscard]] std::uint64_t render_cycles() const { return rendered - started; }
};

struct BoardRun {
    std::vector<RenderedCycle> cycles;
    Snapshot begin;
    Snapshot first_rendered;  // when the first cycle was rendered, and its transfer could begin
    Snapshot rendered;        // when the last cycle was rendered
    Snapshot end;             // when its images had arrived
};

class Board {
public:
    // `shuffle_seed` other than 0: blocks are ticked in random order (for tests; nothing may change).
    explicit Board(const BoardConfig& config, std::uint64_t shuffle_seed = 0);

    // Puts the object into memory without a clock, as if loaded long ago. Fails where the board cannot draw it
    // (drawable), or where slots or memory are full. Returns its slot.
    Result<int> place(const RaySpaceObject& object);

    // Has the controller load it from its disk; the slot becomes valid when finish_loads() returns without error.
    Result<int> start_load(const RaySpaceObject& object);

    // Runs until the disk controller is idle. Fails with the slot of a load that failed; that slot is free again.
    Status finish_loads();

    // Frees the slot. Fails where it is empty, still loading, or used by a cycle that is submitted and not
    // drawn yet.
    Status evict(int slot);

    // Registers of a view of the object in `slot`; fails for a view that is not upright.
    Result<BoardView> view(int slot, const engine::ViewRegisters& registers) const;

    // Gives a cycle to the board whatever its state, as a careless driver would; a refusal stands in
    // top().render_control.refusals(). render() below does it with care.
    void submit(std::vector<BoardView> views);

    // Renders the cycles one behind the other, two in flight, until all images are in the host's memory. Fails where
    // the board refuses one (bad registers), or stands still.
    Result<BoardRun> render(const std::vector<std::vector<BoardView>>& cycles);

    [[nodiscard]] BoardTop& top() { return *top_; }
    [[nodiscard]] const BoardTop& top() const { return *top_; }
    [[nodiscard]] const MemoryMap& memory_map() const { return map_; }
    [[nodiscard]] std::vector<const Block*> blocks() const;
    [[nodiscard]] Snapshot snapshot() const;

private:
    struct Slot {
        bool used = false;
        Placement placement;
    };
    Result<int> take_slot(const RaySpaceObject& object);
    ObjectImage image_of(const RaySpaceObject& object, int slot);
    [[nodiscard]] RenderedCycle collect(std::uint64_t cycle);

    std::unique_ptr<BoardTop> top_;
    const ObjectLayout& layout_;
    MemoryMap map_;
    std::vector<Slot> slots_;
    std::size_t collected_loads_ = 0;
    std::uint32_t loads_ = 0;  // placed or begun: the serial numbers of the objects
};

}  // namespace rs::engine::model
