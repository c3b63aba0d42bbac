#pragma once
// `rs-engine conformance`: does an implementation compute what the definition says?

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rs::engine {

void add_conformance_command(CLI::App& app, std::function<Status()>& run);

}  // namespace rs::engine
