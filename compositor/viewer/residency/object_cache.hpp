#pragma once
// Cache of a scene's objects within a memory budget. A background thread loads files by load priority: it reserves the
// peak memory of an object before it reads the file, and first evicts objects of the lowest priority if the budget is
// exhausted.
//
// An object in memory is evicted only for one of clearly higher priority (load_priority.hpp). Files that do not fit at
// the moment are skipped until memory is free.
//
// Thread-safety: all functions are called from the rendering thread and never wait for file I/O, except
// wait_for_events().

#include "compositor/viewer/residency/load_priority.hpp"
#include "compositor/viewer/residency/memory_budget.hpp"
#include "compositor/viewer/residency/object_source.hpp"
#include "compositor/viewer/residency/placed_object.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace rs::compositor {

struct CacheEvent {
    enum class Kind {
        kLoaded,    // `object` may be displayed
        kEvicting,  // stop displaying it and call give_back()
        kFailed,    // `why` states the reason; the file is not retried
    };
    Kind kind = Kind::kLoaded;
    std::size_t file = 0;
    std::shared_ptr<const ViewableObject> object;
    std::string why;
};

struct CacheStatistics {
    int loads = 0;
    int evictions = 0;
    int failures = 0;
    std::int64_t budget_bytes = 0;
    std::int64_t used_bytes = 0;
    std::int64_t peak_bytes = 0;
    double longest_load_s = 0;
    double load_s = 0;  // sum over all loads
};

class ObjectCache {
public:
    ObjectCache(std::vector<std::filesystem::path> files, std::unique_ptr<ObjectSource> source,
                std::int64_t budget_bytes);
    ~ObjectCache();  // waits for the current read
    ObjectCache(const ObjectCache&) = delete;
    ObjectCache& operator=(const ObjectCache&) = delete;

    /// Priorities by file index. Loading starts with the first call.
    void set_priorities(std::vector<LoadPriority> priorities);
    /// Same, without blocking on the cache's mutex, which its low-priority thread may hold for a while.
    /// \return false, with nothing changed, if the mutex was locked; retry in the next frame.
    bool try_set_priorities(std::vector<LoadPriority> priorities);

    /// Events since the last call. May be delayed to a later call while the mutex is locked.
    std::vector<CacheEvent> events();
    /// Response to kEvicting: releases the last reference of the caller.
    void give_back(std::shared_ptr<const ViewableObject> object);

    /// Load progress, 0 .. 1.
    [[nodiscard]] float progress(std::size_t file) const;
    /// Duration of the file's last load in seconds; 0 before the first.
    [[nodiscard]] double load_seconds(std::size_t file) const;
    /// True if no more events will occur under the current priorities and all events were fetched.
    [[nodiscard]] bool settled() const;
    /// Blocks until there are events or the cache is settled.
    void wait_for_events();

    [[nodiscard]] CacheStatistics statistics() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rs::compositor
