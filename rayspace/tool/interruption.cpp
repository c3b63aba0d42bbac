#include "rayspace/tool/interruption.hpp"

#include "rayspace/file/file_output.hpp"

#include <pthread.h>

namespace rs {
namespace {

constexpr int kWake = SIGUSR2;  // ends the watcher's wait when the guard ends

}  // namespace

InterruptionGuard::InterruptionGuard() {
    sigemptyset(&watched_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        // What the caller had us ignore (nohup, a shell's background jobs) stays ignored.
        struct sigaction action {};
        const bool ignored = sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
        if (!ignored) sigaddset(&watched_, signal);
    }
    sigaddset(&watched_, kWake);
    // A signal handler may do next to nothing; a thread that waits for the signal may do anything.
    pthread_sigmask(SIG_BLOCK, &watched_, &mask_before_);
    watcher_ = std::thread([this] { watch(); });
}

InterruptionGuard::~InterruptionGuard() {
    done_ = true;
    pthread_kill(watcher_.native_handle(), kWake);  // wakes the watcher, and only it
    watcher_.join();
    pthread_sigmask(SIG_SETMASK, &mask_before_, nullptr);
}

void InterruptionGuard::watch() {
    int received = 0;
    do {
        if (sigwait(&watched_, &received) != 0 || done_) return;
    } while (received == kWake);
    remove_staged_output();
    // To the shell the program ended by the signal, as it would have without this guard.
    std::signal(received, SIG_DFL);
    pthread_sigmask(SIG_UNBLOCK, &watched_, nullptr);
    std::raise(received);
}

}  // namespace rs
