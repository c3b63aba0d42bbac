#include "rayspace/tool/interruption.hpp"

#include "rayspace/file/file_output.hpp"

#include <pthread.h>

#include <chrono>

namespace rs {
namespace {

constexpr int kWake = SIGUSR2;  // ends the watcher's wait when the guard ends

// Launchers of many processes send the signal several times at once.
constexpr std::chrono::seconds kOneRequest(3);

std::atomic<bool> noting{false};
std::atomic<int> noted{0};

}  // namespace

void note_interruptions() {
    noting = true;
}

int interruption() {
    return noted;
}

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
    std::chrono::steady_clock::time_point first;
    for (;;) {
        if (sigwait(&watched_, &received) != 0 || done_) return;
        if (received == kWake) continue;
        const auto now = std::chrono::steady_clock::now();
        if (!noting || (noted != 0 && now - first > kOneRequest)) break;
        if (noted == 0) first = now;
        noted = received;
    }
    remove_staged_output();
    // To the shell the program ended by the signal, as it would have without this guard.
    std::signal(received, SIG_DFL);
    pthread_sigmask(SIG_UNBLOCK, &watched_, nullptr);
    std::raise(received);
}

}  // namespace rs
