#include "compositor/viewer/residency/object_cache.hpp"

#include "rayspace/base/check.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace rs::compositor {
namespace {

// Until others who still use an object have let it go.
constexpr std::chrono::milliseconds kPatience(5);

std::string mebibytes(std::int64_t bytes) {
    return std::to_string((bytes + (1 << 20) - 1) >> 20) + " MiB";
}

// An object with the memory that it takes; that is given back when the last who uses the object is done with it.
struct StoredObject {
    MemoryLease lease;
    ViewableObject object;
};

enum class Stage {
    kUnmeasured,
    kAway,
    kLoading,
    kHere,
    kLeaving,  // its user has been told to let it go
    kFailed,
};

struct File {
    std::filesystem::path path;
    Stage stage = Stage::kUnmeasured;
    std::int64_t most_bytes = 0;                 // while it is read
    std::shared_ptr<const StoredObject> object;  // while it is here
    double load_s = 0;
    std::atomic<float> progress = 0;
};

}  // namespace

struct ObjectCache::State {
    State(std::vector<std::filesystem::path> paths, std::unique_ptr<ObjectSource> its_source, std::int64_t budget)
        : files(paths.size()), source(std::move(its_source)), memory(budget) {
        for (std::size_t i = 0; i < paths.size(); ++i) files[i].path = std::move(paths[i]);
    }

    std::vector<File> files;
    std::unique_ptr<ObjectSource> source;  // of the cache's thread
    MemoryBudget memory;

    mutable std::mutex mutex;  // of what follows and the files, progress excepted
    std::condition_variable for_thread;
    std::condition_variable for_user;
    std::vector<LoadPriority> priorities;  // [file]; empty before the first
    std::vector<CacheEvent> events;
    std::vector<std::shared_ptr<const ViewableObject>> given_back;
    StoreStatistics statistics;
    bool idle = false;  // the thread has nothing to do until somebody calls
    bool stopping = false;
    std::thread thread;

    void set_priorities(std::vector<LoadPriority> changed) {
        RS_CHECK(changed.size() == files.size());
        if (changed == priorities) return;
        priorities = std::move(changed);
        idle = false;
        for_thread.notify_all();
    }

    void fail(std::size_t file, const std::string& why) {
        files[file].stage = Stage::kFailed;
        ++statistics.failures;
        events.push_back({CacheEvent::Kind::kFailed, file, nullptr, why});
        for_user.notify_all();
    }

    // The files in a stage, by their load priority.
    [[nodiscard]] std::vector<std::size_t> by_priority(Stage stage) const {
        std::vector<std::size_t> found;
        for (std::size_t i = 0; i < files.size(); ++i) {
            if (files[i].stage == stage) found.push_back(i);
        }
        std::stable_sort(found.begin(), found.end(), [&](auto a, auto b) { return priorities[a] < priorities[b]; });
        return found;
    }

    void measure(std::unique_lock<std::mutex>& lock, std::size_t file) {
        const std::filesystem::path path = files[file].path;
        lock.unlock();
        const Result<std::int64_t> bytes = source->most_bytes(path);
        lock.lock();
        if (!bytes) return fail(file, bytes.error().message);
        if (*bytes > memory.budget_bytes()) {
            return fail(file, path.string() + ": needs " + mebibytes(*bytes) +
                                  " of memory to be read, more than the budget of " + mebibytes(memory.budget_bytes()) +
                                  " (--memory)");
        }
        files[file].most_bytes = *bytes;
        files[file].stage = Stage::kAway;
    }

    void load(std::unique_lock<std::mutex>& lock, std::size_t number, MemoryLease lease) {
        File& file = files[number];
        file.stage = Stage::kLoading;
        file.progress = 0;
        lock.unlock();
        const auto begin = std::chrono::steady_clock::now();
        Result<ViewableObject> read =
            source->read(file.path, lease.bytes(), [&file](float progress) { file.progress = progress; });
        std::shared_ptr<const StoredObject> object;
        std::string why;
        if (read) {
            const std::int64_t bytes = read->memory_bytes();
            if (bytes <= lease.bytes()) {
                lease.shrink(bytes);
                object = std::make_shared<const StoredObject>(StoredObject{std::move(lease), std::move(*read)});
            } else {
                why = file.path.string() + ": takes more memory than was foreseen; encode it anew";
            }
        } else {
            why = read.error().message;
        }
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        lock.lock();
        if (!object) return fail(number, why);
        file.stage = Stage::kHere;
        file.load_s = seconds;
        file.object = object;
        ++statistics.loads;
        statistics.load_s += seconds;
        statistics.longest_load_s = std::max(statistics.longest_load_s, seconds);
        events.push_back({CacheEvent::Kind::kArrived, number, {object, &object->object}, {}});
        for_user.notify_all();
    }

    // Has those of least priority let go, until there will be `bytes`; nothing happens where that cannot be reached
    // with those that give way. True where somebody is leaving.
    bool make_room(std::size_t next, std::int64_t bytes) {
        std::int64_t free = memory.budget_bytes() - memory.used_bytes();
        std::vector<std::size_t> held;
        bool leaving = false;
        for (std::size_t i = 0; i < files.size(); ++i) {
            if (files[i].stage == Stage::kLeaving) {
                leaving = true;
                if (files[i].object) free += files[i].object->lease.bytes();
            }
            if (files[i].stage == Stage::kHere && gives_way(priorities[i], priorities[next])) held.push_back(i);
        }
        if (leaving && free >= bytes) return true;
        std::stable_sort(held.begin(), held.end(), [&](auto a, auto b) { return priorities[a] > priorities[b]; });
        std::size_t count = 0;
        while (free < bytes && count < held.size()) free += files[held[count++]].object->lease.bytes();
        if (free < bytes) return leaving;
        for (std::size_t n = 0; n < count; ++n) {
            File& file = files[held[n]];
            file.stage = Stage::kLeaving;
            ++statistics.evictions;
            // An arrival that nobody has seen is no news any more.
            const auto unseen = std::find_if(events.begin(), events.end(), [&](const CacheEvent& event) {
                return event.file == held[n] && event.kind == CacheEvent::Kind::kArrived;
            });
            const std::shared_ptr<const ViewableObject> object(file.object, &file.object->object);
            if (unseen != events.end()) {
                events.erase(unseen);
                given_back.push_back(object);
            } else {
                events.push_back({CacheEvent::Kind::kLeaves, held[n], object, {}});
            }
        }
        for_user.notify_all();
        return true;
    }

    // Frees what was given back: unmapping large memory takes a while, and no frame is to wait for it.
    void free_given_back(std::unique_lock<std::mutex>& lock) {
        std::vector<std::shared_ptr<const ViewableObject>> gone = std::move(given_back);
        given_back.clear();
        std::vector<std::shared_ptr<const StoredObject>> stored;
        for (File& file : files) {
            const bool back = std::any_of(gone.begin(), gone.end(), [&](const auto& object) {
                return file.object && object.get() == &file.object->object;
            });
            if (!back) continue;
            RS_CHECK(file.stage == Stage::kLeaving);
            file.stage = Stage::kAway;
            file.progress = 0;
            stored.push_back(std::move(file.object));
            file.object.reset();
        }
        lock.unlock();
        gone.clear();
        stored.clear();
        lock.lock();
    }

    // One step towards what the priorities require. False where there is nothing to do.
    bool advance(std::unique_lock<std::mutex>& lock) {
        if (!given_back.empty()) {
            free_given_back(lock);
            return true;
        }
        if (priorities.empty()) return false;
        if (const auto unmeasured = by_priority(Stage::kUnmeasured); !unmeasured.empty()) {
            measure(lock, unmeasured.front());
            return true;
        }
        bool waits = false;
        for (const std::size_t next : by_priority(Stage::kAway)) {
            const std::int64_t bytes = files[next].most_bytes;
            if (auto lease = memory.reserve(bytes)) {
                load(lock, next, std::move(*lease));
                return true;
            }
            waits = make_room(next, bytes) || somebody_still_uses_memory();
            if (waits) break;
        }
        if (waits && given_back.empty()) for_thread.wait_for(lock, kPatience);
        return waits;
    }

    void work() {
        std::unique_lock lock(mutex);
        while (!stopping) {
            if (advance(lock)) continue;
            idle = true;
            for_user.notify_all();
            for_thread.wait(lock, [&] { return stopping || !idle; });
        }
    }

    // More than the objects here take: what left is still used by a cycle that is being drawn.
    [[nodiscard]] bool somebody_still_uses_memory() const {
        std::int64_t held = 0;
        for (const File& file : files) held += file.object ? file.object->lease.bytes() : 0;
        return memory.used_bytes() > held;
    }
};

ObjectCache::ObjectCache(std::vector<std::filesystem::path> files, std::unique_ptr<ObjectSource> source,
                         std::int64_t budget_bytes)
    : state_(std::make_unique<State>(std::move(files), std::move(source), budget_bytes)) {
    state_->statistics.budget_bytes = budget_bytes;
    state_->thread = std::thread([state = state_.get()] { state->work(); });
}

ObjectCache::~ObjectCache() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->stopping = true;
    }
    state_->for_thread.notify_all();
    state_->thread.join();
}

void ObjectCache::set_priorities(std::vector<LoadPriority> priorities) {
    const std::lock_guard lock(state_->mutex);
    state_->set_priorities(std::move(priorities));
}

bool ObjectCache::try_set_priorities(std::vector<LoadPriority> priorities) {
    const std::unique_lock lock(state_->mutex, std::try_to_lock);
    if (!lock) return false;
    state_->set_priorities(std::move(priorities));
    return true;
}

std::vector<CacheEvent> ObjectCache::events() {
    const std::unique_lock lock(state_->mutex, std::try_to_lock);
    if (!lock) return {};
    return std::exchange(state_->events, {});
}

void ObjectCache::give_back(std::shared_ptr<const ViewableObject> object) {
    const std::lock_guard lock(state_->mutex);
    state_->given_back.push_back(std::move(object));
    state_->idle = false;
    state_->for_thread.notify_all();
}

float ObjectCache::progress(std::size_t file) const {
    return state_->files[file].progress;
}

double ObjectCache::load_seconds(std::size_t file) const {
    const std::lock_guard lock(state_->mutex);
    return state_->files[file].load_s;
}

bool ObjectCache::settled() const {
    const std::lock_guard lock(state_->mutex);
    return state_->idle && state_->events.empty();
}

void ObjectCache::wait_for_events() {
    std::unique_lock lock(state_->mutex);
    state_->for_user.wait(lock, [&] { return state_->idle || !state_->events.empty(); });
}

StoreStatistics ObjectCache::statistics() const {
    const std::lock_guard lock(state_->mutex);
    StoreStatistics statistics = state_->statistics;
    statistics.used_bytes = state_->memory.used_bytes();
    statistics.peak_bytes = state_->memory.peak_bytes();
    return statistics;
}

}  // namespace rs::compositor
