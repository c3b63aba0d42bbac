#pragma once
// The commands of rs-engine. Each adds itself to `app`, and sets `run` where it is the one that is called.

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rs::engine {

// Does an implementation compute what the definition states?
void add_conformance_command(CLI::App& app, std::function<Status()>& run);
// Views against the photos of a capture set.
void add_compare_command(CLI::App& app, std::function<Status()>& run);
// Views of an object as images, a contact sheet or a video.
void add_render_command(CLI::App& app, std::function<Status()>& run);
// The commands of the hardware models, which are the two below; none where the build leaves them out
// (RAYSPACE_HARDWARE).
void add_hardware_commands(CLI::App& app, std::function<Status()>& run);
// Memory that objects take on the published board.
void add_board_command(CLI::App& app, std::function<Status()>& run);
// Views rendered by the cycle-accurate model of a board, and where its cycles went.
void add_simulate_command(CLI::App& app, std::function<Status()>& run);

}  // namespace rs::engine
