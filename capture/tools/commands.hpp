#pragma once
// The commands of rs-capture. Each adds itself to `app`, and sets `run` where it is the one that is called.

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rs::capture {

// The calibration board that is laid on the turntable, to be printed.
void add_board_command(CLI::App& app, std::function<Status()>& run);
// Photographs of an object on a turntable, cut out and calibrated, as a capture set.
void add_import_command(CLI::App& app, std::function<Status()>& run);
// What a photometric file (IES, EULUMDAT) holds, as numbers and as a polar plot.
void add_luminaire_command(CLI::App& app, std::function<Status()>& run);
// A scene, traced from a ring of cameras or from given poses, as a capture set.
void add_synth_command(CLI::App& app, std::function<Status()>& run);

}  // namespace rs::capture
