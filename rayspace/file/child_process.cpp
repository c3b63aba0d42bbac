#include "rayspace/file/child_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>

namespace rs {
namespace {

// Reads the descriptor to its end.
void read_lines(int descriptor, const OutputLine& on_line) {
    std::string line;
    std::array<char, 4096> block{};
    for (;;) {
        const ssize_t count = ::read(descriptor, block.data(), block.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) break;
        for (const char c : std::string_view(block.data(), static_cast<std::size_t>(count))) {
            if (c != '\n') {
                line += c;
                continue;
            }
            on_line(line);
            line.clear();
        }
    }
    if (!line.empty()) on_line(line);
}

Result<int> wait_for(pid_t child) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) return Error{std::strerror(errno)};
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Result<int> run_program(const std::vector<std::string>& words, const OutputLine& on_line) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    std::array<int, 2> ends{-1, -1};  // of the pipe: read, write
    if (on_line && ::pipe2(ends.data(), O_CLOEXEC) != 0) return Error{std::strerror(errno)};
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions, on_line ? ends[1] : STDERR_FILENO, STDOUT_FILENO);
    if (on_line) ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    pid_t child = 0;
    const int failure = ::posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (on_line) {
        ::close(ends[1]);
        if (failure == 0) read_lines(ends[0], on_line);
        ::close(ends[0]);
    }
    if (failure != 0) return Error{std::strerror(failure)};
    return wait_for(child);
}

}  // namespace rs
