#pragma once
// What Ctrl-C leaves behind: nothing half-made. Part of the tools' frame (tool_main.hpp).

#include <atomic>
#include <csignal>
#include <thread>

namespace rs {

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
