#pragma once
// The frame of every tool's main: parse -> run -> exit code. Exit 0: done; 1: failed, one line "TOOL: error: ..." on
// stderr; 2: wrong usage. Ctrl-C (SIGINT), SIGTERM and SIGHUP remove staged output before they end the program. Data
// goes to stdout, log and progress to stderr. Exceptions that escape a library are caught here as a last
// resort and reported as errors (std::bad_alloc: "out of memory").

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace rs {

inline constexpr int kExitOk = 0;
inline constexpr int kExitFailed = 1;
inline constexpr int kExitUsage = 2;

// `app` has its subcommands set up; each subcommand's callback stores what to run in `run`.
int tool_main(CLI::App& app, int argc, char** argv, std::function<Status()>& run);

// For CLI::Option::check() of a file to be written: its name must end in one of `endings`, as ".rso", in any case, so
// that a slip does not cost an image or a page that is there.
std::function<std::string(const std::string&)> ends_in(std::vector<std::string> endings);

// "640x480" -> {640, 480}; both 1..kMaxImageSide_px.
struct PixelSize {
    int width = 0;
    int height = 0;
};
Result<PixelSize> parse_size(const std::string& text);

// "0.5,1,-2" -> three numbers; `what` names the option in the error.
struct Triple {
    double x = 0, y = 0, z = 0;
};
Result<Triple> parse_triple(const std::string& text, const std::string& what);

}  // namespace rs
