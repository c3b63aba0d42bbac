#include "engine/driver/board_thread.hpp"

#include <exception>
#include <utility>

namespace rs::engine {

namespace {

// Converts exceptions of a driver, such as std::bad_alloc, into errors.
template <class Outcome, class Call>
Outcome guarded(const Call& call) {
    try {
        return call();
    } catch (const std::exception& escaped) {
        return Error{std::string("the board's driver failed: ") + escaped.what()};
    }
}

}  // namespace

BoardThread::BoardThread(std::unique_ptr<Executor> device) : device_(std::move(device)) {
    thread_ = std::thread([this] { work(); });
}

BoardThread::~BoardThread() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void BoardThread::add(std::uint32_t number, std::shared_ptr<const RaySpaceObject> object) {
    const std::lock_guard lock(mutex_);
    objects_[number].object = std::move(object);
}

void BoardThread::remove(std::uint32_t number) {
    const std::lock_guard lock(mutex_);
    const auto found = objects_.find(number);
    if (found == objects_.end()) return;
    if (found->second.slot) slots_to_free_.push_back(*found->second.slot);
    objects_.erase(found);
    changed_.notify_all();
}

void BoardThread::request(const std::vector<std::uint32_t>& numbers) {
    const std::lock_guard lock(mutex_);
    ++now_;
    for (const std::uint32_t number : numbers) {
        const auto found = objects_.find(number);
        if (found == objects_.end()) continue;
        found->second.last_requested = now_;
        found->second.waits = !found->second.slot && !found->second.failed;
    }
    changed_.notify_all();
}

void BoardThread::wait_for_loads() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !loading_ && !next_to_load(); });
}

bool BoardThread::reserve() {
    const std::lock_guard lock(mutex_);
    if (loading_) return false;
    reserved_ = true;
    return true;
}

bool BoardThread::holds(std::uint32_t number) const {
    const std::lock_guard lock(mutex_);
    const auto found = objects_.find(number);
    return found != objects_.end() && found->second.slot;
}

std::optional<std::string> BoardThread::load_refusal(std::uint32_t number) const {
    const std::lock_guard lock(mutex_);
    const auto found = objects_.find(number);
    if (found == objects_.end() || found->second.refusal.empty()) return std::nullopt;
    return found->second.refusal;
}

void BoardThread::draw(std::vector<ObjectView> views) {
    const std::lock_guard lock(mutex_);
    reserved_ = false;
    changed_.notify_all();
    if (views.empty()) return;
    std::vector<SlotView> cycle;
    for (ObjectView& view : views) {
        // The object may have been removed after holds().
        const auto found = objects_.find(view.object);
        if (found == objects_.end() || !found->second.slot) {
            drawn_.emplace(Error{"object " + std::to_string(view.object) + " was removed from the board"});
            return;
        }
        cycle.push_back(
            {.slot = *found->second.slot, .registers = std::move(view.registers), .may_defer = view.may_defer});
    }
    drawn_.reset();
    cycle_ = std::move(cycle);
}

Result<std::vector<ExecutedView>> BoardThread::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return drawn_.has_value(); });
    Result<std::vector<ExecutedView>> drawn = std::move(*drawn_);
    drawn_.reset();
    return drawn;
}

BoardThreadCounts BoardThread::counts() const {
    const std::lock_guard lock(mutex_);
    return counts_;
}

// Most recently requested object of those that wait.
std::optional<std::uint32_t> BoardThread::next_to_load() const {
    std::optional<std::uint32_t> best;
    for (const auto& [number, object] : objects_) {
        if (object.waits && (!best || object.last_requested > objects_.at(*best).last_requested)) best = number;
    }
    return best;
}

std::optional<std::uint32_t> BoardThread::least_requested(std::uint64_t before) const {
    std::optional<std::uint32_t> best;
    for (const auto& [number, object] : objects_) {
        if (!object.slot || object.last_requested >= before) continue;
        if (!best || object.last_requested < objects_.at(*best).last_requested) best = number;
    }
    return best;
}

void BoardThread::note_failure(const Error& error) {
    counts_.last_failure = error.message;
}

void BoardThread::evict_slot(std::unique_lock<std::mutex>& lock, int slot) {
    lock.unlock();
    const Status evicted = guarded<Status>([&] { return device_->evict(slot); });
    lock.lock();
    if (!evicted) note_failure(evicted.error());
}

// Loads the next object and evicts less recently requested objects if there is no room. Drops the request if no such
// object is left.
void BoardThread::load_one(std::unique_lock<std::mutex>& lock) {
    const std::uint32_t number = *next_to_load();
    const std::shared_ptr<const RaySpaceObject> object = objects_.at(number).object;
    const std::uint64_t requested = objects_.at(number).last_requested;
    loading_ = true;
    for (;;) {
        lock.unlock();
        const auto slot = guarded<Result<std::optional<int>>>([&] { return device_->load(*object); });
        lock.lock();
        const auto found = objects_.find(number);
        if (!slot) {
            ++counts_.failed_loads;
            note_failure(slot.error());
            if (found != objects_.end()) {
                found->second.failed = true;
                found->second.waits = false;
                found->second.refusal = "the board failed to load it: " + slot.error().message;
            }
            break;
        }
        if (*slot) {
            ++counts_.loads;
            if (found == objects_.end()) {
                slots_to_free_.push_back(**slot);
            } else {
                found->second.slot = **slot;
                found->second.waits = false;
                found->second.refusal.clear();
            }
            break;
        }
        const std::optional<std::uint32_t> victim = least_requested(requested);
        if (!victim || found == objects_.end()) {
            if (found != objects_.end()) {
                found->second.waits = false;
                found->second.refusal =
                    "the board's memory or slots are full of objects of the same views; use fewer or smaller objects";
            }
            break;
        }
        const int freed = *std::exchange(objects_.at(*victim).slot, std::nullopt);
        ++counts_.evictions;
        evict_slot(lock, freed);
    }
    loading_ = false;
    changed_.notify_all();
}

void BoardThread::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [&] {
            return stopping_ || cycle_ || (!reserved_ && (!slots_to_free_.empty() || next_to_load().has_value()));
        });
        if (cycle_) {
            const std::vector<SlotView> views = std::move(*cycle_);
            cycle_.reset();
            lock.unlock();
            auto drawn = guarded<Result<std::vector<ExecutedView>>>([&] { return device_->render(views); });
            lock.lock();
            if (!drawn) {
                ++counts_.failed_cycles;
                note_failure(drawn.error());
            }
            drawn_.emplace(std::move(drawn));
            changed_.notify_all();
        } else if (stopping_) {
            return;
        } else if (!slots_to_free_.empty()) {
            const int slot = slots_to_free_.back();
            slots_to_free_.pop_back();
            evict_slot(lock, slot);
        } else {
            load_one(lock);
        }
    }
}

}  // namespace rs::engine
