#pragma once
// `rs-capture board`: prints the calibration board that is laid on the turntable.

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rs::capture {

void add_board_command(CLI::App& app, std::function<Status()>& run);

}  // namespace rs::capture
