#pragma once
// Subcommands of rs-encode. Each function adds one to `app`; its callback sets `run`.

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rs::encode {

/// Builds an object, and optionally a report, from a capture set.
void add_build_command(CLI::App& app, std::function<Status()>& run);
/// Measures quality on held-out views of a set.
void add_evaluate_command(CLI::App& app, std::function<Status()>& run);
/// Inspection of objects.
void add_info_command(CLI::App& app, std::function<Status()>& run);
void add_verify_command(CLI::App& app, std::function<Status()>& run);
void add_extract_command(CLI::App& app, std::function<Status()>& run);

}  // namespace rs::encode
