#pragma once
// Object source for residency tests: small drums with configurable size and load time, counted independently of
// budgets.

#include "compositor/viewer/residency/object_source.hpp"
#include "tests/compositor/objects.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace rs::test {

// Events of the source, which the cache owns, and of its objects, which have shared owners.
struct SourceLog {
    std::mutex mutex;
    std::vector<std::string> read;  // names, in order
    std::int64_t alive_bytes = 0;   // of objects, and of the one being read
    std::int64_t most_alive_bytes = 0;

    void add(std::int64_t bytes) {
        const std::lock_guard lock(mutex);
        alive_bytes += bytes;
        most_alive_bytes = std::max(most_alive_bytes, alive_bytes);
    }
    std::vector<std::string> names() {
        const std::lock_guard lock(mutex);
        return read;
    }
};

struct SlowSourceOptions {
    std::chrono::microseconds reading{0};
    std::set<std::string> broken;             // files that fail to load
    std::set<std::string> gone;               // files whose size cannot be determined
    std::map<std::string, int> times_larger;  // memory factor while loading
};

class SlowSource final : public compositor::ObjectSource {
public:
    SlowSource(std::shared_ptr<SourceLog> log, SlowSourceOptions options)
        : log_(std::move(log)), options_(std::move(options)) {}

    // Size of an object in memory.
    static std::int64_t object_bytes() {
        static const std::int64_t bytes = drum()->memory_bytes() + std::int64_t{4096};
        return bytes;
    }
    static std::int64_t reading_bytes() { return 2 * object_bytes(); }

    Result<std::int64_t> most_bytes(const std::filesystem::path& file) override {
        if (options_.gone.contains(file.string())) return Error{file.string() + ": is not there"};
        const auto larger = options_.times_larger.find(file.string());
        return reading_bytes() * (larger == options_.times_larger.end() ? 1 : larger->second);
    }

    Result<compositor::ViewableObject> read(const std::filesystem::path& file, std::int64_t most_bytes,
                                            const ProgressCallback& on_progress) override {
        log_->add(most_bytes);
        on_progress(0.5F);
        std::this_thread::sleep_for(options_.reading);
        {
            const std::lock_guard lock(log_->mutex);
            log_->read.push_back(file.string());
        }
        if (options_.broken.contains(file.string())) {
            log_->add(-most_bytes);
            return Error{file.string() + ": is broken"};
        }
        static const RaySpaceObject kDrum = drum_object();
        Result<compositor::ViewableObject> viewable = compositor::make_viewable(kDrum);
        log_->add(object_bytes() - most_bytes);
        // Released with the object.
        viewable->for_board =
            std::shared_ptr<const RaySpaceObject>(new RaySpaceObject(), [log = log_](const auto* object) {
                delete object;
                log->add(-object_bytes());
            });
        return viewable;
    }

private:
    std::shared_ptr<SourceLog> log_;
    SlowSourceOptions options_;
};

}  // namespace rs::test
