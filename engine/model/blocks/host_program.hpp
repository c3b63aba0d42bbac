#pragma once
// What stands in the host's memory: the register values that its driver writes for each rendering cycle, and the
// pictures that the board sends. Not blocks: the world around the board.

#include "engine/model/registers.hpp"

#include <cstdint>
#include <deque>
#include <vector>

namespace rs::engine::model {

struct HostProgram {
    ViewBank bank;
    int register_writes = 0;  // 32-bit writes that carry it over the bus
};

// [number of the start command]
using HostPrograms = std::deque<HostProgram>;

struct HostPicture {
    int view = 0;
    bool last_view = false;
    std::uint64_t arrived = 0;  // bus clock of its last word
    std::vector<std::uint64_t> words;
    std::size_t expected_words = 0;
};

}  // namespace rs::engine::model
