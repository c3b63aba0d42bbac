#include "engine/model/layout/memory_map.hpp"

#include <algorithm>
#include <limits>

namespace rs::engine::model {
MemoryMap::MemoryMap(const MemorySettings& settings) {
    for (std::size_t n = 0; n < kObjectRegions; ++n) {
        const RegionBanks& banks = settings.regions.objects[n];
        spaces_[n].name = banks.name;
        std::replace(spaces_[n].name.begin(), spaces_[n].name.end(), '_', ' ');
        spaces_[n].all = {static_cast<std::uint64_t>(banks.first) * settings.shape.words_per_bank(),
                          static_cast<std::uint64_t>(banks.count) * settings.shape.words_per_bank()};
    }
}

Result<Placement> MemoryMap::allocate(const std::array<std::uint64_t, kObjectRegions>& words, const std::string& name) {
    Placement placement;
    placement.words = words;
    std::array<std::size_t, kObjectRegions> places{};  // indices into the lists of runs
    for (std::size_t n = 0; n < kObjectRegions; ++n) {
        const Space& space = spaces_[n];
        std::uint64_t at = space.all.first;
        std::size_t place = 0;
        while (place < space.taken.size() && space.taken[place].first - at < words[n]) {
            at = space.taken[place].first + space.taken[place].words;
            ++place;
        }
        if (space.all.first + space.all.words - at < words[n]) {
            return Error{name + ": board memory is full: it needs " + std::to_string(words[n] * 8) + " bytes of " +
                         space.name + " in one piece, and " + std::to_string(free_words(static_cast<Region>(n)) * 8) +
                         " of " + std::to_string(space.all.words * 8) +
                         " are free; evict an object, or encode it smaller"};
        }
        placement.first[n] = static_cast<WordAddress>(at);
        places[n] = place;
    }
    for (std::size_t n = 0; n < kObjectRegions; ++n) {
        std::vector<Run>& taken = spaces_[n].taken;
        taken.insert(taken.begin() + static_cast<std::ptrdiff_t>(places[n]), {placement.first[n], words[n]});
    }
    return placement;
}

void MemoryMap::release(const Placement& placement) {
    for (std::size_t n = 0; n < kObjectRegions; ++n) {
        std::vector<Run>& taken = spaces_[n].taken;
        const auto run = std::find_if(taken.begin(), taken.end(), [&](const Run& r) {
            return r.first == placement.first[n] && r.words == placement.words[n];
        });
        RS_CHECK(run != taken.end());
        taken.erase(run);
    }
}

std::uint64_t MemoryMap::copies(const std::array<std::uint64_t, kObjectRegions>& words) const {
    std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    for (std::size_t n = 0; n < kObjectRegions; ++n) {
        if (words[n] > 0) most = std::min(most, spaces_[n].all.words / words[n]);
    }
    return most;
}

std::uint64_t MemoryMap::capacity_words(Region region) const {
    return spaces_[static_cast<std::size_t>(region)].all.words;
}

std::uint64_t MemoryMap::free_words(Region region) const {
    const Space& space = spaces_[static_cast<std::size_t>(region)];
    std::uint64_t free = space.all.words;
    for (const Run& run : space.taken) free -= run.words;
    return free;
}

}  // namespace rs::engine::model
