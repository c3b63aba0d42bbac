#pragma once
// `rs-engine render`: views of an object as pictures, a contact sheet or a video.

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rs::engine {

void add_render_command(CLI::App& app, std::function<Status()>& run);

}  // namespace rs::engine
