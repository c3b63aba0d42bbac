#pragma once
// The thread that owns a board: draws its part of rendering cycles, one at a time, and between them keeps the objects
// that views need in the board's memory, evicting those that were not needed for the longest time.
//
// Thread-safety: every member function may be called from any thread, but reserve(), draw() and wait() belong together,
// from one.

#include "rayspace/api/types/executor.hpp"

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace rs::engine {

struct BoardThreadCounts {
    std::int64_t loads = 0;
    std::int64_t evictions = 0;  // to make room
    std::int64_t failed_loads = 0;
    std::int64_t failed_cycles = 0;
    std::string last_failure;
};

class BoardThread {
public:
    explicit BoardThread(std::unique_ptr<Executor> device);
    ~BoardThread();  // finishes the cycle being drawn
    BoardThread(const BoardThread&) = delete;
    BoardThread& operator=(const BoardThread&) = delete;

    [[nodiscard]] const Executor& device() const { return *device_; }

    // Objects are known by numbers that are never used twice. An object that the board takes; it is loaded when
    // requested.
    void add(std::uint32_t number, std::shared_ptr<const RaySpaceObject> object);
    void remove(std::uint32_t number);

    // The objects are needed now: those in the board's memory stay there; those that are not are loaded soon.
    void request(const std::vector<std::uint32_t>& numbers);

    // Waits until what is requested is in the board's memory, or does not go there.
    void wait_for_loads();

    // Keeps the board from loading until draw(). False, and nothing is kept, where it is loading already.
    [[nodiscard]] bool reserve();
    // Whether the object is in the board's memory.
    [[nodiscard]] bool holds(std::uint32_t number) const;

    struct ObjectView {
        std::uint32_t object = 0;
        ViewRegisters registers;
    };
    // After reserve(): begins to draw views of objects that it holds. No views: the board is free again.
    void draw(std::vector<ObjectView> views);
    // Waits for them. Fails, too, where an object was removed since.
    Result<std::vector<ExecutedView>> wait();

    [[nodiscard]] BoardThreadCounts counts() const;

private:
    struct Known {
        std::shared_ptr<const RaySpaceObject> object;
        std::optional<int> slot;
        std::uint64_t last_requested = 0;
        bool waits = false;   // to be loaded
        bool failed = false;  // could not be; not tried again
    };
    void work();
    void load_one(std::unique_lock<std::mutex>& lock);
    [[nodiscard]] std::optional<std::uint32_t> next_to_load() const;
    [[nodiscard]] std::optional<std::uint32_t> least_requested(std::uint64_t before) const;
    void evict_slot(std::unique_lock<std::mutex>& lock, int slot);
    void note_failure(const Error& error);

    std::unique_ptr<Executor> device_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::map<std::uint32_t, Known> known_;
    std::vector<int> slots_to_free_;
    std::uint64_t now_ = 0;  // counts request()
    std::optional<std::vector<SlotView>> cycle_;
    std::optional<Result<std::vector<ExecutedView>>> drawn_;
    BoardThreadCounts counts_;
    bool loading_ = false;
    bool reserved_ = false;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace rs::engine
