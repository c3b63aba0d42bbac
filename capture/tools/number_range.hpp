#pragma once
// A check of a numeric option's range.

#include <CLI/CLI.hpp>

namespace rs::capture {

// A number in [low, high]; CLI::Range alone lets NaN pass.
CLI::Validator within(double low, double high);

}  // namespace rs::capture
