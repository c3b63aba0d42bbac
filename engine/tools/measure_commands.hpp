#pragma once
// `rs-engine compare` and `board`: how good and how large an object is.

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rs::engine {

void add_compare_command(CLI::App& app, std::function<Status()>& run);
void add_board_command(CLI::App& app, std::function<Status()>& run);

}  // namespace rs::engine
