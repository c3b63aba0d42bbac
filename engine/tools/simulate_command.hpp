#pragma once
// `rs-engine simulate`: views drawn by the cycle-accurate model of the board, and where its cycles went.

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rs::engine {

void add_simulate_command(CLI::App& app, std::function<Status()>& run);

}  // namespace rs::engine
