#pragma once
// Work that is done once, by whoever needs it first, and can be taken back: std::call_once with a way to forget.

#include <atomic>
#include <cstdint>

namespace rs::engine {

class DoneFlag {
public:
    [[nodiscard]] bool done() const { return state_.load(std::memory_order_acquire) == kDone; }

    // Returns after work() was done, here or in another thread, which is waited for. What work() wrote is seen then.
    // Where work() throws, it is not done: who called it gets the exception, and one of those who wait tries it.
    // Work may ensure other flags, in an order without cycles.
    template <class Work>
    void ensure(const Work& work) {
        std::uint8_t seen = state_.load(std::memory_order_acquire);
        while (seen != kDone) {
            if (seen == kNotDone && state_.compare_exchange_strong(seen, kBusy, std::memory_order_acquire)) {
                try {
                    work();
                } catch (...) {
                    set(kNotDone);
                    throw;
                }
                set(kDone);
                return;
            }
            if (seen == kBusy) state_.wait(kBusy, std::memory_order_acquire);
            seen = state_.load(std::memory_order_acquire);
        }
    }

    // While no other thread uses the flag.
    void reset() { state_.store(kNotDone, std::memory_order_relaxed); }

private:
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
