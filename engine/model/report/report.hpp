#pragma once
// Reports of a board: cycles of every block of a run by activity, traffic on memory and bus, the limiting block, and
// the tables of its diagram.

#include "engine/model/board.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace rs::engine::model {

struct BlockShare {
    std::string name;
    std::uint64_t cycles = 0;  // cycles of its own clock
    ActivityCounts counts;
    [[nodiscard]] double share(Activity activity) const {
        return cycles == 0 ? 0 : double(counts.of(activity)) / double(cycles);
    }
    [[nodiscard]] double occupied() const { return cycles == 0 ? 0 : double(counts.occupied()) / double(cycles); }
};

struct Interval {
    double seconds = 0;
    std::uint64_t board_cycles = 0;
    std::vector<BlockShare> blocks;  // instances in several pipes are added up
    std::string limiting_block;      // the block with the largest occupied share
};

struct MemoryTraffic {
    std::string client;
    std::uint64_t words = 0;
    std::uint64_t nulls = 0;
};

// A memory channel. Its peak is a word of 8 bytes a cycle.
struct ChannelReport {
    std::uint64_t words = 0;  // words moved since the board was made
    std::vector<MemoryTraffic> clients;
    MemoryController::Counters counters;
    BlockShare rendering;  // cycles of its controller while rendering: busy is data moved, the rest is the cost of
                           // rows, turnarounds of the data bus and refresh
};

// Rates of rendering cycles.
struct RenderRates {
    int cycles = 0;  // rendering cycles
    int images = 0;
    std::int64_t pixels = 0;
    std::uint64_t render_cycles = 0;  // sum of the board cycles in which a rendering cycle was drawn
    double pixels_per_second = 0;     // while drawing
    double cycles_per_second = 0;     // drawn
    double arrivals_per_second = 0;   // rendering cycles that arrive at the host per second; 0 for fewer than two
};
RenderRates render_rates(const std::vector<RenderedCycle>& cycles, double clock_mhz);

struct BoardReport : RenderRates {
    std::string config;
    double clock_mhz = 0;
    Interval rendering;              // until the last image was in the image buffer
    Interval delivering;             // from the first finished rendering cycle until the last had arrived at the host
    std::uint64_t board_cycles = 0;  // of the whole run
    std::vector<MemoryTraffic> memory;  // of channel 0, since the board was made
    MemoryController::Counters counters;
    std::vector<ChannelReport> channels;
    HostBus::Counters bus;
};

BoardReport make_report(const Board& board, const BoardRun& run);

std::string report_json(const BoardReport& report);

// Stacked bars of activity shares, one bar per block. `title` is the heading.
std::string report_chart_svg(const BoardReport& report, const std::string& title);

// Rates at which a board's bus delivers a cycle of `images` images of side_px x side_px, if they are always drawn in
// time and the host writes no registers meanwhile.
struct BusRates {
    double image_bytes_per_second = 0;  // within bursts; image bytes, also where the bus carries fewer
    double cycle_seconds = 0;           // with the driver's pauses
};
BusRates bus_rates(const BoardConfig& config, int images, int side_px);

// Table of DIAGRAM.md: the buses of prototype-2000, of the paper's remedies and of parallel, with their rates for nine
// images of 256x256. Markdown; a test compares it with the page.
std::string bus_table();

// Tables of DIAGRAM.md, generated from the declarations of a board's blocks and FIFOs; a test compares them with the
// page. Two tables as Markdown: blocks with clock, timing and ports; FIFOs with depth, width and the blocks at their
// ends. For a parallel board one pipe represents all ("_pN"), and a third table lists its block RAM.
std::string diagram_tables(const BoardTop& board);

}  // namespace rs::engine::model
