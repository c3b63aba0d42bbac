#pragma once
// Signal handling of the tools (tool_main.hpp): an interrupted tool leaves no partial files.

#include <atomic>
#include <csignal>
#include <thread>

namespace rs {

/// During its lifetime, SIGINT, SIGTERM and SIGHUP remove the temporary output of this process (temporary.hpp) before
/// they end it in the default way. Must be created on the main thread before any other thread, so that all threads
/// inherit its signal mask.
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
