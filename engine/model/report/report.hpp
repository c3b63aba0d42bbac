#pragma once
// What a run of the board reports: where every block's cycles went, what moved over the memory and the bus, and which
// block limited it.

#include "engine/model/board.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace rs::engine::model {

struct BlockShare {
    std::string name;
    std::uint64_t cycles = 0;  // of its own clock
    ActivityCounts counts;
    [[nodiscard]] double share(Activity activity) const {
        return cycles == 0 ? 0 : double(counts.of(activity)) / double(cycles);
    }
    [[nodiscard]] double occupied() const { return cycles == 0 ? 0 : double(counts.occupied()) / double(cycles); }
};

struct Interval {
    double seconds = 0;
    std::uint64_t board_cycles = 0;
    std::vector<BlockShare> blocks;  // those that stand in every pipe are added up
    std::string limiting_block;      // the one that its own work and losses occupy most
};

struct MemoryTraffic {
    std::string client;
    std::uint64_t words = 0;
    std::uint64_t nulls = 0;
};

// A memory channel. Its peak is a word of 8 bytes a cycle.
struct ChannelReport {
    std::uint64_t words = 0;  // that moved, since the board was made
    std::vector<MemoryTraffic> clients;
    MemoryController::Counters counters;
    BlockShare rendering;  // its controller's cycles while rendering: busy is what moved, the rest what rows, turns of
                           // the data bus and refresh cost
};

struct BoardReport {
    std::string config;
    double clock_mhz = 0;
    int cycles = 0;  // rendering cycles
    int images = 0;
    std::int64_t pixels = 0;
    Interval rendering;               // until the last image stood in the image buffer
    Interval delivering;              // from the first finished rendering cycle until the last had arrived at the host
    std::uint64_t board_cycles = 0;   // of the whole run
    std::uint64_t render_cycles = 0;  // board cycles in which a rendering cycle was drawn, all added up
    double pixels_per_second = 0;     // while drawing
    double cycles_per_second = 0;     // drawn
    double arrivals_per_second = 0;   // rendering cycles that arrive at the host, in a row; 0 for fewer than two
    std::vector<MemoryTraffic> memory;  // of channel 0, since the board was made
    MemoryController::Counters counters;
    std::vector<ChannelReport> channels;
    HostBus::Counters bus;
};

BoardReport make_report(const Board& board, const BoardRun& run);

std::string report_json(const BoardReport& report);

// Stacked bars, a block each: the shares of what it did. `title` stands above.
std::string report_chart_svg(const BoardReport& report, const std::string& title);

}  // namespace rs::engine::model
