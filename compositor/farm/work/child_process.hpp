#pragma once
// A program beside this one: an item's work. What it does wrong, it does to itself alone: where MPI runs, a rank that
// ends by a signal takes all others with it.

#include "rayspace/base/result.hpp"

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rs::farm {

struct ChildOptions {
    std::filesystem::path log;             // takes what it prints
    std::vector<std::string> environment;  // "NAME=value", beside this process' own
    std::vector<int> processors;           // that it may use; empty: those of this process
};

struct ChildEnd {
    int exit_code = 0;
    int signal = 0;  // that ended it; 0: none
    std::int64_t peak_memory_bytes = 0;
    double seconds = 0;
};

// Move-only; one thread, which must be the process' first: the child is killed when that ends, however it ends.
class ChildProcess {
public:
    // `arguments` begins with the program's path.
    static Result<ChildProcess> start(const std::vector<std::string>& arguments, const ChildOptions& options);
    ChildProcess(ChildProcess&& other) noexcept;
    ChildProcess& operator=(ChildProcess&& other) noexcept;
    // Asks it to end (SIGTERM), which the tools do at once and clean up; a second later it is killed.
    ~ChildProcess();

    // Nothing while it runs.
    std::optional<ChildEnd> poll();
    ChildEnd wait();

private:
    ChildProcess() = default;
    pid_t process_ = -1;
    double begun_s_ = 0;
};

}  // namespace rs::farm
