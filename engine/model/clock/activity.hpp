#pragma once
// Activity of a block in one cycle. Every block reports exactly one activity per cycle of its clock, so the counts of a
// block add up to its elapsed cycles.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace rs::engine::model {

enum class Activity : std::uint8_t {
    busy,         // did useful work
    idle,         // no input
    output_full,  // had a result, but its output FIFO was full
    memory_port,  // needed the memory, and its request FIFO was full
    memory_data,  // waited for data from the memory
    row_miss,     // memory: a row of a bank is closed and opened
    turnaround,   // memory: the data bus changes its direction; bus: the idle clock between two masters
    maintenance,  // memory: refresh, and the window in which the private bus writes
    arbitration,  // bus: waited for the grant
    target_wait,  // bus: the target was not ready, or answered with a retry
    master_wait,  // bus: the board's own wait states
    disk_wait,    // the disk had no data
    buffer_wait,  // both image buffers are full, or there is no command
    count_of_all,
};
inline constexpr std::size_t kActivities = static_cast<std::size_t>(Activity::count_of_all);

constexpr std::string_view activity_name(Activity activity) {
    constexpr std::array<std::string_view, kActivities> kNames = {
        "busy",        "idle",        "output_full", "memory_port", "memory_data", "row_miss",   "turnaround",
        "maintenance", "arbitration", "target_wait", "master_wait", "disk_wait",   "buffer_wait"};
    return kNames[static_cast<std::size_t>(activity)];
}

// True if the block itself used the time: work, or losses of its own interface. The block with the largest share of
// these limits the others.
constexpr bool is_occupied(Activity activity) {
    switch (activity) {
        case Activity::busy:
        case Activity::row_miss:
        case Activity::turnaround:
        case Activity::maintenance:
        case Activity::arbitration:
        case Activity::target_wait:
        case Activity::master_wait:
            return true;
        default:
            return false;
    }
}

// True for activities that count as progress. Waiting for the disk counts, because it has its own timeout
// (disk_controller); all other waiting does not.
constexpr bool is_progress(Activity activity) {
    return activity == Activity::busy || activity == Activity::disk_wait;
}

struct ActivityCounts {
    std::array<std::uint64_t, kActivities> cycles{};
    [[nodiscard]] std::uint64_t of(Activity activity) const { return cycles[static_cast<std::size_t>(activity)]; }
    [[nodiscard]] std::uint64_t total() const {
        std::uint64_t sum = 0;
        for (const std::uint64_t c : cycles) sum += c;
        return sum;
    }
    [[nodiscard]] std::uint64_t occupied() const {
        std::uint64_t sum = 0;
        for (std::size_t a = 0; a < kActivities; ++a) sum += is_occupied(static_cast<Activity>(a)) ? cycles[a] : 0;
        return sum;
    }
};

}  // namespace rs::engine::model
