#pragma once
// The commands of rs-engine. Each adds itself to `app`, and sets `run` where it is the one that is called.

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rs::engine {

// Does an implementation compute what the definition states?
void add_conformance_command(CLI::App& app, std::function<Status()>& run);
// How good and how large an object is.
void add_compare_command(CLI::App& app, std::function<Status()>& run);
void add_board_command(CLI::App& app, std::function<Status()>& run);
// Views of an object as images, a contact sheet or a video.
void add_render_command(CLI::App& app, std::function<Status()>& run);
// Views drawn by the cycle-accurate model of a board, and where its cycles went.
void add_simulate_command(CLI::App& app, std::function<Status()>& run);

}  // namespace rs::engine
