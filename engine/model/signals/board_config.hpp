#pragma once
// Configuration of the board: clocks, memory chips, buses and limits, built in or read from JSON. DIAGRAM.md, section
// "Where the numbers come from", separates published values from choices of this model.

#include "engine/model/limits/board_limits.hpp"
#include "rayspace/base/result.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rs::engine::model {

// Times in cycles of the board's clock, from command to command.
struct SdramTiming {
    int activate_to_column = 1;     // tRCD
    int precharge_to_activate = 1;  // tRP
    int activate_to_precharge = 2;  // tRAS, minimum
    int activate_to_activate = 3;   // tRC, same bank
    int write_to_precharge = 1;     // tWR, after the cycle of the write
    int refresh_to_any = 3;         // tRFC
    int read_latency = 2;           // CAS latency
    int interface_latency = 2;      // registers at the FPGA's pins, out and in, added to the read latency
};

// Word address (8 bytes): bank region | row | column; a region is one bank of one rank.
struct SdramShape {
    int bank_bits = 4;  // 4 ranks of 4 banks
    int row_bits = 13;
    int column_bits = 10;
    [[nodiscard]] int address_bits() const { return bank_bits + row_bits + column_bits; }
    [[nodiscard]] std::uint64_t words() const { return std::uint64_t{1} << address_bits(); }
    [[nodiscard]] std::uint64_t words_per_bank() const { return std::uint64_t{1} << (row_bits + column_bits); }
};

// Banks of each kind of data; the streams of an image are in different banks.
struct RegionBanks {
    const char* name = "";
    int first = 0;
    int count = 0;
};
inline constexpr std::size_t kObjectRegions = 4;
struct MemoryRegions {
    std::array<RegionBanks, kObjectRegions> objects = {  // Region of memory_map.hpp
        {{"luma", 0, 8}, {"chroma", 8, 4}, {"alpha", 12, 2}, {"tables", 14, 1}}};
    RegionBanks images{"images", 15, 1};
    int image_parts = 1;  // 2: each of the two image buffers has half of the banks
};

struct MemorySettings {
    SdramShape shape;
    SdramTiming timing;
    MemoryRegions regions;
    int maintenance_interval = 312;  // cycles; 8192 rows in 64 ms
    int load_words_per_window = 20;  // of the private bus, in the maintenance window
    int write_batch = 8;             // image words written together
};

// Bus that carries images to the host, or to the graphics card. Its clock does not depend on the board's.
struct PciSettings {
    int clock_mhz = 33;     // nominal: 33, 66 (PCI) or 133 (PCI-X), which are 100/3, 200/3 and 400/3 MHz
    int width_bits = 32;    // of a transfer: 32 or 64
    int burst_words = 4;    // 64-bit words on the bus per burst: a cache line of 32 bytes
    int grant_clocks = 3;   // from REQ# to the address: two of the arbiter, and one in which the bus is sampled idle
    int target_clocks = 8;  // from the address to the first data: the host bridge snoops the processor's cache
    int wait_per_transfer = 1;   // wait states of the board per transfer
    int register_clocks = 4;     // a register write of the host
    int interrupt_clocks = 330;  // from the end of an image's transfer to the next: 10 us of the driver
    int dedicated = 0;           // 1: images have this bus to themselves; the host writes registers over another one
    int compression = 1;         // words of an image per word on the bus; 2 assumes a coder, which is not modelled
    int retry_every = 0;         // fault injection: the target retries every n-th burst; 0 = never

    [[nodiscard]] double mhz() const { return thirds_of_mhz() / 3.0; }
    [[nodiscard]] int thirds_of_mhz() const { return clock_mhz == 33 ? 100 : clock_mhz == 66 ? 200 : 400; }
    // 64-bit words of an image that a full burst carries.
    [[nodiscard]] int image_words_per_burst() const { return burst_words * compression; }
};

struct DiskSettings {
    int cycles_per_transfer = 4;               // of the private bus: 16 bits at 10 MHz
    std::uint64_t start_cycles = 0;            // before the first byte: seek and rotation
    int media_cycles_per_sector = 820;         // 512 bytes: 25 MByte/s off the platter
    int buffer_sectors = 64;                   // the drive's own buffer
    std::uint64_t stall_after_bytes = 0;       // fault injection: the drive stops delivering here; 0 = never
    std::uint64_t stall_cycles = 0;            // duration of the stall
    std::uint64_t timeout_cycles = 4'000'000;  // a load that receives no byte for this time fails: 0.1 s
};

struct BoardConfig {
    std::string name;
    int clock_mhz = 40;  // of the board: its logic, its memory and the private bus of its disk
    BoardLimits limits;
    MemorySettings memory;
    PciSettings pci;
    DiskSettings disk;
    int pipes = 0;  // pipes of a parallel board, each with a memory channel; 0: one pipe and one channel, as in 2000
    int queue_cycles = 2;  // rendering cycles whose registers the board holds
    std::uint64_t no_progress_cycles = 20'000;

    // Periods of both clocks in their largest common unit: 5 and 6 (of 5 ns) for 40 and 33 MHz.
    struct Periods {
        int board = 0;
        int bus = 0;
    };
    [[nodiscard]] Periods clock_periods() const;
};

// "prototype-2000": the published board. "compressed-2000": the same board with images that stay compressed in its
// memory. "parallel": sixteen pipes, each with a memory channel; also renders objects with a shape map.
std::vector<std::string> built_in_configs();

// The published board with each remedy that the paper names for its bus (section 7): "prototype-2000-pci-x",
// "prototype-2000-dedicated", "prototype-2000-compressed-transfer".
std::vector<std::string> bus_remedy_configs();

// Reads a configuration by the name of a built-in, or from a JSON file: {"base": "prototype-2000", "memory": {...},
// ...} overrides values of its base. Fails on an unknown name or key, a wrong type, or a value out of range; the
// message names it.
Result<BoardConfig> read_board_config(const std::string& name_or_path);
Result<BoardConfig> parse_board_config(const std::string& json, const std::string& where);

// All values of a configuration, as JSON that read_board_config() accepts.
std::string board_config_json(const BoardConfig& config);

}  // namespace rs::engine::model
