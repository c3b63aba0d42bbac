#include "tests/hostile/surviving.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>

namespace rs::test {

namespace {

using Clock = std::chrono::steady_clock;

// State shared by parent and child.
struct Report {
    std::uint64_t seed;   // seed of the running trial
    std::int32_t trials;  // number of started trials
    std::int32_t failed;  // 1 if `wrong` is not empty
    char wrong[1000];
};

Report* shared_report() {
    void* const page = ::mmap(nullptr, sizeof(Report), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return page == MAP_FAILED ? nullptr : static_cast<Report*>(page);
}

void fail(Report& report, const std::string& wrong) {
    std::strncpy(report.wrong, wrong.c_str(), sizeof report.wrong - 1);
    report.failed = 1;
    ::_exit(1);
}

[[noreturn]] void run_trials(Report& report, std::uint64_t seed, Clock::time_point end, const Limits& limits,
                             const std::function<std::string(std::uint64_t)>& trial) {
    for (; Clock::now() < end; ++seed) {
        report.seed = seed;
        ++report.trials;
        ::alarm(limits.trial_s);
        const std::string wrong = trial(seed);
        ::alarm(0);
        if (!wrong.empty()) fail(report, wrong);
        struct rusage used {};
        if (::getrusage(RUSAGE_SELF, &used) == 0 && std::int64_t{used.ru_maxrss} * 1024 > limits.memory_bytes) {
            fail(report, "took " + std::to_string(used.ru_maxrss / 1024) + " MiB");
        }
    }
    ::_exit(0);
}

}  // namespace

double hostile_seconds() {
    const char* const given = std::getenv("RAYSPACE_HOSTILE_SECONDS");
    return given != nullptr ? std::atof(given) : 3;
}

std::uint64_t hostile_seed() {
    const char* const given = std::getenv("RAYSPACE_HOSTILE_SEED");
    return given != nullptr ? std::strtoull(given, nullptr, 10) : 1;
}

int survive(const std::function<std::string(std::uint64_t seed)>& trial, const Limits& limits) {
    const auto end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(hostile_seconds()));
    Report* const report = shared_report();
    if (report == nullptr) {
        ADD_FAILURE() << "no shared memory";
        return 0;
    }
    int trials = 0;
    constexpr int kMostFailures = 5;
    std::uint64_t seed = hostile_seed();
    for (int failures = 0; failures < kMostFailures && Clock::now() < end;) {
        *report = {};
        const pid_t child = ::fork();
        if (child == 0) run_trials(*report, seed, end, limits, trial);
        int status = 0;
        ::waitpid(child, &status, 0);
        trials += report->trials;
        seed = report->seed + 1;
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0) continue;
        ++failures;
        const std::string how = report->failed != 0                                  ? report->wrong
                                : WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM ? "hangs"
                                : WIFSIGNALED(status) ? std::string("dies: ") + strsignal(WTERMSIG(status))
                                                      : "ends with " + std::to_string(WEXITSTATUS(status));
        ADD_FAILURE() << "RAYSPACE_HOSTILE_SEED=" << report->seed << ": " << how;
    }
    ::munmap(report, sizeof(Report));
    ::testing::Test::RecordProperty("trials", trials);
    return trials;
}

}  // namespace rs::test
