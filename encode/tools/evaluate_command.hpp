#pragma once
// `rs-encode evaluate`: how good an object of a set is, on views that are held out of it.

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rs::encode {

void add_evaluate_command(CLI::App& app, std::function<Status()>& run);

}  // namespace rs::encode
