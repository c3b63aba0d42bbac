#pragma once
// The commands of rs-encode. Each adds itself to `app`, and sets `run` where it is the one that is called.

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rs::encode {

// A capture set as an object, and a page about it.
void add_build_command(CLI::App& app, std::function<Status()>& run);
// How good an object of a set is, on views that are held out of it.
void add_evaluate_command(CLI::App& app, std::function<Status()>& run);
// A look into objects.
void add_info_command(CLI::App& app, std::function<Status()>& run);
void add_verify_command(CLI::App& app, std::function<Status()>& run);
void add_extract_command(CLI::App& app, std::function<Status()>& run);

}  // namespace rs::encode
