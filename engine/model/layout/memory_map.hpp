#pragma once
// Allocator of object memory. Each kind of data has its banks (MemoryRegions); an object occupies one run of words
// in each of four regions, first fit.

#include "engine/model/signals/board_config.hpp"
#include "engine/model/signals/registers.hpp"

#include <array>
#include <string>
#include <vector>

namespace rs::engine::model {

enum class Region { luma, chroma, alpha, tables, flat_tiles = luma, predicted_tiles = chroma, tile_table = alpha };

struct Placement {
    std::array<WordAddress, kObjectRegions> first{};
    std::array<std::uint64_t, kObjectRegions> words{};
};

class MemoryMap {
public:
    explicit MemoryMap(const MemorySettings& settings);

    // Allocates the given number of words per region. Fails, and allocates nothing, if a region has no such run; `name`
    // is the object's, for the error.
    Result<Placement> allocate(const std::array<std::uint64_t, kObjectRegions>& words, const std::string& name);
    void release(const Placement& placement);

    // Number of objects with the given words per region that fit into the empty memory.
    [[nodiscard]] std::uint64_t copies(const std::array<std::uint64_t, kObjectRegions>& words) const;

    [[nodiscard]] std::uint64_t capacity_words(Region region) const;
    [[nodiscard]] std::uint64_t free_words(Region region) const;

private:
    struct Run {
        std::uint64_t first = 0;
        std::uint64_t words = 0;
    };
    struct Space {
        std::string name;
        Run all;
        std::vector<Run> taken;  // ordered by address
    };
    std::array<Space, kObjectRegions> spaces_;
};

}  // namespace rs::engine::model
