#pragma once
// `rs-encode build`: a capture set as an object, and a page about it.

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rs::encode {

void add_build_command(CLI::App& app, std::function<Status()>& run);

}  // namespace rs::encode
