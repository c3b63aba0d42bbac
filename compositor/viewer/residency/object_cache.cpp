#include "compositor/viewer/residency/object_cache.hpp"

#include "rayspace/api/types/check.hpp"

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

// Polling interval while other owners still use an evicted object.
constexpr std::chrono::milliseconds kRetryInterval(5);

std::string mebibytes(std::int64_t bytes) {
    return std::to_string((bytes + (1 << 20) - 1) >> 20) + " MiB";
}

// Object and its memory lease, which is returned with the last reference to the object.
struct StoredObject {
    MemoryLease lease;
    ViewableObject object;
};

enum class Stage {
    kUnmeasured,
    kAway,
    kLoading,
    kHere,
    kEvicting,  // eviction was requested
    kFailed,
};

struct File {
    std::filesystem::path path;
    Stage stage = Stage::kUnmeasured;
    std::int64_t most_bytes = 0;                 // while loading
    std::shared_ptr<const StoredObject> object;  // while loaded
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
    std::unique_ptr<ObjectSource> source;  // used by the cache's thread
    MemoryBudget memory;

    mutable std::mutex mutex;  // protects the following members and `files`, except progress
    std::condition_variable for_thread;
    std::condition_variable for_user;
    std::vector<LoadPriority> priorities;  // [file]; empty before the first call
    std::vector<CacheEvent> events;
    std::vector<std::shared_ptr<const ViewableObject>> released_objects;
    CacheStatistics statistics;
    bool idle = false;  // the thread waits for calls
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

    // Files of a stage, ordered by load priority.
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
                why = file.path.string() + ": needs more memory than estimated; encode it again";
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
        events.push_back({CacheEvent::Kind::kLoaded, number, {object, &object->object}, {}});
        for_user.notify_all();
    }

    // Requests evictions, lowest priority first, until `bytes` will be free; does nothing if evictable objects do not
    // suffice.
    // True if an eviction is pending.
    bool request_evictions(std::size_t next, std::int64_t bytes) {
        std::int64_t free = memory.budget_bytes() - memory.used_bytes();
        std::vector<std::size_t> held;
        bool leaving = false;
        for (std::size_t i = 0; i < files.size(); ++i) {
            if (files[i].stage == Stage::kEvicting) {
                leaving = true;
                if (files[i].object) free += files[i].object->lease.bytes();
            }
            if (files[i].stage == Stage::kHere && is_evictable_for(priorities[i], priorities[next])) held.push_back(i);
        }
        if (leaving && free >= bytes) return true;
        std::stable_sort(held.begin(), held.end(), [&](auto a, auto b) { return priorities[a] > priorities[b]; });
        std::size_t count = 0;
        while (free < bytes && count < held.size()) free += files[held[count++]].object->lease.bytes();
        if (free < bytes) return leaving;
        for (std::size_t n = 0; n < count; ++n) {
            File& file = files[held[n]];
            file.stage = Stage::kEvicting;
            ++statistics.evictions;
            // A load event that was not fetched yet is withdrawn.
            const auto unseen = std::find_if(events.begin(), events.end(), [&](const CacheEvent& event) {
                return event.file == held[n] && event.kind == CacheEvent::Kind::kLoaded;
            });
            const std::shared_ptr<const ViewableObject> object(file.object, &file.object->object);
            if (unseen != events.end()) {
                events.erase(unseen);
                released_objects.push_back(object);
            } else {
                events.push_back({CacheEvent::Kind::kEvicting, held[n], object, {}});
            }
        }
        for_user.notify_all();
        return true;
    }

    // Frees returned objects on this thread: unmapping large memory is slow and must not delay a frame.
    void free_released_objects(std::unique_lock<std::mutex>& lock) {
        std::vector<std::shared_ptr<const ViewableObject>> gone = std::move(released_objects);
        released_objects.clear();
        std::vector<std::shared_ptr<const StoredObject>> stored;
        for (File& file : files) {
            const bool back = std::any_of(gone.begin(), gone.end(), [&](const auto& object) {
                return file.object && object.get() == &file.object->object;
            });
            if (!back) continue;
            RS_CHECK(file.stage == Stage::kEvicting);
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

    // One step towards the priorities. False if there is nothing to do.
    bool advance(std::unique_lock<std::mutex>& lock) {
        if (!released_objects.empty()) {
            free_released_objects(lock);
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
            waits = request_evictions(next, bytes) || has_pending_owners();
            if (waits) break;
        }
        if (waits && released_objects.empty()) for_thread.wait_for(lock, kRetryInterval);
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

    // True if more memory is reserved than loaded objects take: a running cycle still uses an evicted object.
    [[nodiscard]] bool has_pending_owners() const {
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
    state_->released_objects.push_back(std::move(object));
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

CacheStatistics ObjectCache::statistics() const {
    const std::lock_guard lock(state_->mutex);
    CacheStatistics statistics = state_->statistics;
    statistics.used_bytes = state_->memory.used_bytes();
    statistics.peak_bytes = state_->memory.peak_bytes();
    return statistics;
}

}  // namespace rs::compositor
