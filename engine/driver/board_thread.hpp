#pragma once
// Thread that owns a board. It renders the board's part of each rendering cycle, one cycle at a time. Between cycles it
// loads requested objects into the board's memory and evicts the least recently requested ones.
//
// Thread-safety: every member function may be called from any thread, but reserve(), draw() and wait() must be called
// in this order from one thread.

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
    ~BoardThread();  // finishes the current cycle
    BoardThread(const BoardThread&) = delete;
    BoardThread& operator=(const BoardThread&) = delete;

    [[nodiscard]] const Executor& device() const { return *device_; }

    /// Adds an object that the board supports; it is loaded when requested. Numbers are never reused.
    void add(std::uint32_t number, std::shared_ptr<const RaySpaceObject> object);
    void remove(std::uint32_t number);

    /// Requests objects: those in the board's memory are kept there, the others are queued for loading.
    void request(const std::vector<std::uint32_t>& numbers);

    /// Waits until every requested object is in the board's memory or cannot be loaded.
    void wait_for_loads();

    /// Suspends loading until draw(). Returns false without any effect if the board is loading already.
    [[nodiscard]] bool reserve();
    /// True if the object is in the board's memory.
    [[nodiscard]] bool holds(std::uint32_t number) const;
    /// Reason for which the last request of the object did not load it; nullopt if it is loaded, queued or unknown.
    [[nodiscard]] std::optional<std::string> load_refusal(std::uint32_t number) const;

    struct ObjectView {
        std::uint32_t object = 0;
        ViewRegisters registers;
        bool may_defer = false;  // SlotView::may_defer
    };
    /// After reserve(): starts rendering views of objects in the board's memory. An empty list only releases the board.
    void draw(std::vector<ObjectView> views);
    /// Waits for the views of draw(). \return error if rendering failed or an object was removed after holds()
    Result<std::vector<ExecutedView>> wait();

    [[nodiscard]] BoardThreadCounts counts() const;

private:
    struct BoardObject {
        std::shared_ptr<const RaySpaceObject> object;
        std::optional<int> slot;
        std::uint64_t last_requested = 0;
        bool waits = false;   // queued for loading
        bool failed = false;  // loading failed; not retried
        std::string refusal;  // why the last attempt did not load it; empty if it did
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
    std::map<std::uint32_t, BoardObject> objects_;
    std::vector<int> slots_to_free_;
    std::uint64_t now_ = 0;  // number of request() calls
    std::optional<std::vector<SlotView>> cycle_;
    std::optional<Result<std::vector<ExecutedView>>> drawn_;
    BoardThreadCounts counts_;
    bool loading_ = false;
    bool reserved_ = false;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace rs::engine
