#pragma once
// The options of `rs-capture synth --as-photos`: test photographs instead of a capture set.

#include "capture/tracer/session/photo_session.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <vector>

namespace rs::capture {

// A check of a numeric option's range.

// A number in [low, high]; CLI::Range alone lets NaN pass.
CLI::Validator within(double low, double high);

struct AsPhotosOptions {
    bool asked = false;
    PhotoOptions photos;  // what --as-photos alone decides; the rest is filled in from the other options of `synth`
};

// Every option but --as-photos itself is wrong usage without it. `options` must outlive `synth`.
void add_as_photos_options(CLI::App& synth, AsPhotosOptions& options);

// The images that the options name.
std::vector<std::filesystem::path> input_files(const AsPhotosOptions& options);

// For the end of `synth --help`.
extern const char* const kAsPhotosExamples;

}  // namespace rs::capture
