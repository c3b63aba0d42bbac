#pragma once
// `rs-capture import`: photographs of an object on a turntable, cut out and given a nominal rig, as a capture set.

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rs::capture {

void add_import_command(CLI::App& app, std::function<Status()>& run);

}  // namespace rs::capture
