#pragma once
// Main function of every tool: parse, run, exit code. Exit 0: success; 1: failed, with one line "TOOL: error: ..." on
// stderr; 2: wrong usage. Ctrl-C (SIGINT), SIGTERM and SIGHUP remove staged output before they end the program. Data
// goes to stdout, log and progress to stderr. Exceptions that escape a library are caught as a last resort and reported
// as errors (std::bad_alloc: "out of memory").

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace rs {

inline constexpr int kExitOk = 0;
inline constexpr int kExitFailed = 1;
inline constexpr int kExitUsage = 2;

/// Runs a tool. `app` has its subcommands; their callbacks set `run`.
int tool_main(CLI::App& app, int argc, char** argv, std::function<Status()>& run);

/// For CLI::Option::check() of an output file: its name must have one of the extensions `endings`, such as ".rso"
/// (case-insensitive), so that a typing error does not overwrite another file.
std::function<std::string(const std::string&)> ends_in(std::vector<std::string> endings);

/// "640x480" -> {640, 480}; both 1..kMaxImageSide_px.
struct PixelSize {
    int width = 0;
    int height = 0;
};
Result<PixelSize> parse_size(const std::string& text);

/// "0.5,1,-2" -> three numbers; `what` names the option in the error.
struct Triple {
    double x = 0, y = 0, z = 0;
};
Result<Triple> parse_triple(const std::string& text, const std::string& what);

}  // namespace rs
