#pragma once
// The subcommands of rs-capture. Each function adds its subcommand to `app` and sets `run` if it is called.

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rs::capture {

/// Writes a printable calibration board for the turntable.
void add_board_command(CLI::App& app, std::function<Status()>& run);
/// Writes a capture set in the layout of COLMAP or nerfstudio.
void add_export_command(CLI::App& app, std::function<Status()>& run);
/// Imports photos of an object on a turntable, or with known cameras: segmented and calibrated, as a capture set.
void add_import_command(CLI::App& app, std::function<Status()>& run);
/// Prints the contents of a photometric file (IES, EULUMDAT), as numbers and as a polar plot.
void add_luminaire_command(CLI::App& app, std::function<Status()>& run);
/// Renders a scene from a ring of cameras or from given poses, as a capture set.
void add_synth_command(CLI::App& app, std::function<Status()>& run);

}  // namespace rs::capture
