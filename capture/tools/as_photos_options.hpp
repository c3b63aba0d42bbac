#pragma once
// Options of `rs-capture synth --as-photos`, which renders test photos instead of a capture set.

#include "capture/tracer/session/photo_session.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <vector>

namespace rs::capture {

/// Accepts a number in [low, high]; CLI::Range alone accepts NaN.
CLI::Validator range(double low, double high);

struct AsPhotosOptions {
    bool is_enabled = false;
    PhotoOptions photos;  // options specific to --as-photos; the rest is copied from the other options of `synth`
};

/// Adds the options; without --as-photos each of them is a usage error. `options` must outlive `synth`.
void add_as_photos_options(CLI::App& synth, AsPhotosOptions& options);

/// Image files named by the options.
std::vector<std::filesystem::path> input_files(const AsPhotosOptions& options);

/// Appended to `synth --help`.
extern const char* const kAsPhotosExamples;

}  // namespace rs::capture
