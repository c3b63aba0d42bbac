#pragma once
// Commands of rs-engine. Each function adds a subcommand to `app`; its callback sets `run`.

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rs::engine {

// Compares implementations with the definition.
void add_conformance_command(CLI::App& app, std::function<Status()>& run);
// Compares views with the photos of a capture set.
void add_compare_command(CLI::App& app, std::function<Status()>& run);
// Renders views of an object as images, a contact sheet or a video.
void add_render_command(CLI::App& app, std::function<Status()>& run);
// Adds the commands of the hardware models, board and simulate; empty in builds without RAYSPACE_HARDWARE.
void add_hardware_commands(CLI::App& app, std::function<Status()>& run);
// Prints the memory that objects take on the published board.
void add_board_command(CLI::App& app, std::function<Status()>& run);
// Renders views with the cycle-accurate model of a board and prints the utilization of its blocks.
void add_simulate_command(CLI::App& app, std::function<Status()>& run);

}  // namespace rs::engine
