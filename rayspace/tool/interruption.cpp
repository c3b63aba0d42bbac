#include "rayspace/tool/interruption.hpp"

#include "rayspace/file/temporary.hpp"

#include <pthread.h>

namespace rs {
namespace {

constexpr int kWake = SIGUSR2;  // ends the watcher's wait when the guard ends

}  // namespace

InterruptionGuard::InterruptionGuard() {
    sigemptyset(&watched_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        // Signals ignored by the caller (nohup, a shell's background jobs) stay ignored.
        struct sigaction action {};
        const bool ignored = sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
        if (!ignored) sigaddset(&watched_, signal);
    }
    sigaddset(&watched_, kWake);
    // A signal handler may call few functions; a thread that waits for the signal may call all.
    pthread_sigmask(SIG_BLOCK, &watched_, &mask_before_);
    watcher_ = std::thread([this] { watch(); });
}

InterruptionGuard::~InterruptionGuard() {
    done_ = true;
    pthread_kill(watcher_.native_handle(), kWake);  // wakes only the watcher
    watcher_.join();
    pthread_sigmask(SIG_SETMASK, &mask_before_, nullptr);
}

void InterruptionGuard::watch() {
    int received = 0;
    do {
        if (sigwait(&watched_, &received) != 0 || done_) return;
    } while (received == kWake);
    remove_temporaries();
    // Ends by the signal's default action, so that the shell sees the usual status.
    std::signal(received, SIG_DFL);
    pthread_sigmask(SIG_UNBLOCK, &watched_, nullptr);
    std::raise(received);
}

}  // namespace rs
