#pragma once
// What Ctrl-C leaves behind: nothing half-made. Part of the tools' frame (tool_main.hpp).

#include <atomic>
#include <csignal>
#include <thread>

namespace rs {

// From now on the first signal that an InterruptionGuard watches for is only noted, for work that comes to its end by
// itself; one that comes more than three seconds later ends the process. Thread-safe, as interruption() is.
void note_interruptions();
// The signal that was noted; 0 where there was none.
int interruption();

// While it lives, SIGINT, SIGTERM and SIGHUP remove the staged output of this process (file_output.hpp) before they end
// it in their usual way. Made on the main thread before any other thread runs, so that all of them inherit its signal
// mask.
class InterruptionGuard {
public:
    InterruptionGuard();
    InterruptionGuard(const InterruptionGuard&) = delete;
    InterruptionGuard& operator=(const InterruptionGuard&) = delete;
    ~InterruptionGuard();

private:
    void watch();

    sigset_t watched_{};
    sigset_t mask_before_{};
    std::atomic<bool> done_{false};
    std::thread watcher_;
};

}  // namespace rs
