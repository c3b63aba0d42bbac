#pragma once
// `rs-encode info`, `verify` and `extract`: a look into objects.

#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <functional>

namespace rs::encode {

void add_info_command(CLI::App& app, std::function<Status()>& run);
void add_verify_command(CLI::App& app, std::function<Status()>& run);
void add_extract_command(CLI::App& app, std::function<Status()>& run);

}  // namespace rs::encode
