#include "compositor/farm/work/child_process.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

namespace rs::farm {
namespace {

double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> all;
    for (std::string& text : texts) all.push_back(text.data());
    all.push_back(nullptr);
    return all;
}

cpu_set_t set_of(const std::vector<int>& processors) {
    cpu_set_t set;
    CPU_ZERO(&set);
    for (const int processor : processors) CPU_SET(static_cast<std::size_t>(processor), &set);
    return set;
}

}  // namespace

Result<ChildProcess> ChildProcess::start(const std::vector<std::string>& arguments, const ChildOptions& options) {
    const int log = ::open(options.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (log < 0) return Error{options.log.string() + ": cannot be written: " + std::strerror(errno)};
    std::vector<std::string> words = arguments;
    std::vector<std::string> environment = options.environment;
    for (char** variable = environ; *variable != nullptr; ++variable) environment.emplace_back(*variable);
    const std::vector<char*> argv = pointers(words);
    const std::vector<char*> envp = pointers(environment);
    const cpu_set_t processors = set_of(options.processors);
    const pid_t parent = ::getpid();
    sigset_t none;
    sigemptyset(&none);

    // Between fork and exec only what is safe among the threads that MPI has.
    const pid_t child = ::fork();
    if (child == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != parent) ::_exit(127);  // which has ended meanwhile
        const int nothing = ::open("/dev/null", O_RDONLY);
        ::dup2(nothing, STDIN_FILENO);
        ::dup2(log, STDOUT_FILENO);
        ::dup2(log, STDERR_FILENO);
        ::close_range(STDERR_FILENO + 1, ~0U, 0);
        if (!options.processors.empty()) ::sched_setaffinity(0, sizeof processors, &processors);
        ::sigprocmask(SIG_SETMASK, &none, nullptr);
        ::execve(argv.front(), argv.data(), envp.data());
        ::_exit(127);
    }
    const int error = errno;
    ::close(log);
    if (child < 0) return Error{arguments.front() + ": cannot be started: " + std::strerror(error)};
    ChildProcess process;
    process.process_ = child;
    process.begun_s_ = now_s();
    return process;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : process_(std::exchange(other.process_, -1)), begun_s_(other.begun_s_) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
    std::swap(process_, other.process_);
    std::swap(begun_s_, other.begun_s_);
    return *this;
}

ChildProcess::~ChildProcess() {
    if (process_ < 0) return;
    ::kill(process_, SIGTERM);
    const double begun = now_s();
    while (!poll()) {
        if (now_s() - begun > 1) ::kill(process_, SIGKILL);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

std::optional<ChildEnd> ChildProcess::poll() {
    int status = 0;
    rusage usage{};
    if (::wait4(process_, &status, WNOHANG, &usage) != process_) return std::nullopt;
    process_ = -1;
    ChildEnd end;
    end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
    end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    end.peak_memory_bytes = usage.ru_maxrss * 1024LL;
    end.seconds = now_s() - begun_s_;
    return end;
}

ChildEnd ChildProcess::wait() {
    for (;;) {
        if (const std::optional<ChildEnd> end = poll()) return *end;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

}  // namespace rs::farm
