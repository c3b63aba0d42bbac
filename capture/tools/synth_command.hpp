#pragma once
// `rs-capture synth`: a scene, traced from a ring of cameras or from given poses, as a capture set.

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rs::capture {

void add_synth_command(CLI::App& app, std::function<Status()>& run);

}  // namespace rs::capture
