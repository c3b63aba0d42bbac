#include "rayspace/tool/tool_main.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/nearest_name.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/file/temporary.hpp"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <new>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace rs {
namespace {

constexpr int kWake = SIGUSR2;  // ends the watcher's wait when the guard ends

// During its lifetime, SIGINT, SIGTERM and SIGHUP remove the temporary output of this process (temporary.hpp) before
// they end it in the default way. Must be created on the main thread before any other thread, so that all threads
// inherit its signal mask.
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

// Joins the lines of a message, which may quote a library's output: an error is one line.
std::string folded(const std::string& message) {
    std::string line;
    for (const char c : message) {
        const bool is_space = c == '\n' || c == '\r' || c == '\t' || c == ' ';
        if (!is_space) {
            line += c;
        } else if (!line.empty() && line.back() != ' ') {
            line += ' ';
        }
    }
    while (!line.empty() && line.back() == ' ') line.pop_back();
    return line;
}

int fail(const CLI::App& app, const std::string& message) {
    std::fprintf(stderr, "%s: error: %s\n", app.get_name().c_str(), printable(folded(message)).c_str());
    return kExitFailed;
}

// The tool and the subcommands that were parsed, outermost first.
std::vector<const CLI::App*> parsed_commands(const CLI::App& app) {
    std::vector<const CLI::App*> commands = {&app};
    while (!commands.back()->get_subcommands().empty()) commands.push_back(commands.back()->get_subcommands().front());
    return commands;
}

// Help option of the subcommand that was parsed, such as "rs-xxx render --help".
std::string help_command(const CLI::App& app) {
    std::string command;
    for (const CLI::App* at : parsed_commands(app)) command += at->get_name() + " ";
    return command + "--help";
}

// Suggestion for the first unknown option of the subcommand that was parsed.
std::string option_suggestion(const CLI::App& app) {
    std::vector<std::string> known;
    for (const CLI::Option* option : parsed_commands(app).back()->get_options()) {
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
    for (const std::string& word : app.remaining(true)) {
        if (word.starts_with("--")) return suggestion(word.substr(0, word.find('=')), known);
    }
    return "";
}

// Removes a number from the front of `text`; false if it is not a finite number.
template <class T>
bool take_number(std::string_view& text, T& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{}) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return std::isfinite(static_cast<double>(number));
}

bool take(std::string_view& text, char expected) {
    if (text.empty() || text.front() != expected) return false;
    text.remove_prefix(1);
    return true;
}

}  // namespace

int tool_main(CLI::App& app, int argc, char** argv, std::function<Status()>& run) {
    app.set_version_flag("--version", "rayspace " RAYSPACE_VERSION, "Print the version and exit");
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& wanted) {  // --help, --version
        return app.exit(wanted);
    } catch (const CLI::ParseError& wrong) {
        const std::string problem = folded(wrong.what()) + option_suggestion(app);
        std::fprintf(stderr, "%s: %s; see '%s'\n", app.get_name().c_str(), printable(problem).c_str(),
                     help_command(app).c_str());
        return kExitUsage;
    }
    if (!run) {
        std::fprintf(stderr, "%s: nothing to do; see '%s'\n", app.get_name().c_str(), help_command(app).c_str());
        return kExitUsage;
    }
    const InterruptionGuard guard;
    std::signal(SIGXFSZ, SIG_IGN);  // writes beyond the limit return an error instead
    try {
        const Status status = run();
        if (!status) return fail(app, status.error().message);
    } catch (const std::bad_alloc&) {
        return fail(app, "out of memory");
    } catch (const std::system_error& refused) {
        const bool is_short = refused.code() == std::errc::resource_unavailable_try_again ||
                              refused.code() == std::errc::not_enough_memory;
        return fail(
            app, is_short ? "out of memory, or of threads that may be started (ulimit -v, ulimit -u)" : refused.what());
    } catch (const std::exception& escaped) {
        return fail(app, escaped.what());
    }
    // A full disk or a closed pipe is detected only when the buffer is flushed.
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        return fail(app, "standard output cannot be written; check the free disk space");
    }
    return kExitOk;
}

std::function<std::string(const std::string&)> ends_in(std::vector<std::string> endings) {
    return [endings = std::move(endings)](const std::string& name) {
        if (std::ranges::find(endings, lower_case_extension(name)) != endings.end()) return std::string();
        return name + ": must end in " + endings.front();
    };
}

Result<PixelSize> parse_size(const std::string& text) {
    PixelSize size;
    std::string_view rest = text;
    if (!take_number(rest, size.width) || !take(rest, 'x') || !take_number(rest, size.height) || !rest.empty()) {
        return Error{"'" + text + "' is not a size; use WIDTHxHEIGHT, such as 640x480"};
    }
    if (size.width < 1 || size.height < 1 || size.width > kMaxImageSide_px || size.height > kMaxImageSide_px) {
        return Error{"the size " + text + " is out of range; each side must be 1.." + std::to_string(kMaxImageSide_px) +
                     " pixels"};
    }
    return size;
}

Result<Triple> parse_triple(const std::string& text, const std::string& what) {
    Triple triple;
    std::string_view rest = text;
    if (!take_number(rest, triple.x) || !take(rest, ',') || !take_number(rest, triple.y) || !take(rest, ',') ||
        !take_number(rest, triple.z) || !rest.empty()) {
        return Error{what + ": '" + text + "' is not three numbers; use X,Y,Z, such as 0.5,1,-2"};
    }
    return triple;
}

}  // namespace rs
