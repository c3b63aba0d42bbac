#pragma once
// std::call_once with a reset.

#include <atomic>
#include <cstdint>

namespace rs::engine {

class DoneFlag {
public:
    [[nodiscard]] bool done() const { return state_.load(std::memory_order_acquire) == kDone; }

    /// Calls work() unless it has completed; waits if another thread is executing it. The writes of work() are visible
    /// on return. If work() throws, the exception is propagated to its caller and one of the waiting threads retries.
    /// work() may call ensure() of other flags, in an order without cycles.
    template <class Work>
    void ensure(const Work& work) {
        std::uint8_t seen = state_.load(std::memory_order_acquire);
        while (seen != kDone) {
            if (seen == kNotDone && state_.compare_exchange_strong(seen, kBusy, std::memory_order_acquire)) {
                SetOnExit on_exit{*this};
                work();
                on_exit.state = kDone;
                return;
            }
            if (seen == kBusy) state_.wait(kBusy, std::memory_order_acquire);
            seen = state_.load(std::memory_order_acquire);
        }
    }

    /// Requires that no other thread uses the flag.
    void reset() { state_.store(kNotDone, std::memory_order_relaxed); }

private:
    // A destructor instead of a handler, for builds without exceptions.
    struct SetOnExit {
        DoneFlag& flag;
        std::uint8_t state = kNotDone;
        ~SetOnExit() { flag.set(state); }
    };

    void set(std::uint8_t state) {
        state_.store(state, std::memory_order_release);
        state_.notify_all();
    }

    static constexpr std::uint8_t kNotDone = 0;
    static constexpr std::uint8_t kBusy = 1;
    static constexpr std::uint8_t kDone = 2;
    std::atomic<std::uint8_t> state_ = kNotDone;
};

}  // namespace rs::engine
