#pragma once
// Stopwatch for wall time and the CPU time of all threads of the process, since construction.

#include <chrono>
#include <ctime>

namespace rs::bench {

class Stopwatch {
public:
    [[nodiscard]] double wall_s() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    }
    [[nodiscard]] double cpu_s() const { return cpu_now_s() - cpu_begin_s_; }
    [[nodiscard]] double wall_ms() const { return 1e3 * wall_s(); }
    [[nodiscard]] double cpu_ms() const { return 1e3 * cpu_s(); }

private:
    static double cpu_now_s() {
        timespec now{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
        return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    }

    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    double cpu_begin_s_ = cpu_now_s();
};

}  // namespace rs::bench
