#pragma once
// Which of a scene's objects are in memory. A thread of the cache reads them by load priority, and never more
// than the budget holds: before it reads an object it takes what that needs at most from the budget, and where that is
// not free it first has those of least priority let go.
//
// An object that is there leaves only for one of clearly higher priority (load_priority.hpp). One whose memory cannot
// be had is passed over, for as long as that is so.
//
// Thread-safety: everything is called from one thread, the frames', and never waits for a file, but wait_for_events().

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
        kArrived,  // `object` may be shown
        kLeaves,   // stop showing it, and give it back: its memory is needed
        kFailed,   // `why`; it will not come
    };
    Kind kind = Kind::kArrived;
    std::size_t file = 0;
    std::shared_ptr<const ViewableObject> object;
    std::string why;
};

struct StoreStatistics {
    int loads = 0;
    int evictions = 0;
    int failures = 0;
    std::int64_t budget_bytes = 0;
    std::int64_t used_bytes = 0;
    std::int64_t peak_bytes = 0;
    double longest_load_s = 0;
    double load_s = 0;  // of all
};

class ObjectCache {
public:
    ObjectCache(std::vector<std::filesystem::path> files, std::unique_ptr<ObjectSource> source,
                std::int64_t budget_bytes);
    ~ObjectCache();  // waits for the file that is being read
    ObjectCache(const ObjectCache&) = delete;
    ObjectCache& operator=(const ObjectCache&) = delete;

    // [file], from now on. Nothing is read before the first call.
    void set_priorities(std::vector<LoadPriority> priorities);
    // The same for a frame, which is not to wait even for the blink of an eye that the cache's thread, of low priority,
    // may be held up in: false, and nothing is changed, where it is busy. To be set again with the next frame.
    bool try_set_priorities(std::vector<LoadPriority> priorities);

    // What has happened since the last call; may come with a later one while the cache is busy.
    std::vector<CacheEvent> events();
    // The answer to kLeaves: nobody uses the object any more.
    void give_back(std::shared_ptr<const ViewableObject> object);

    // How far reading has come, 0 .. 1.
    [[nodiscard]] float progress(std::size_t file) const;
    // Seconds that the last reading of the file took; 0 before.
    [[nodiscard]] double load_seconds(std::size_t file) const;
    // True where nothing more will happen under the present priorities: what has the highest priority is there, and
    // events are fetched.
    [[nodiscard]] bool settled() const;
    // Waits until there are events or it has settled.
    void wait_for_events();

    [[nodiscard]] StoreStatistics statistics() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rs::compositor
