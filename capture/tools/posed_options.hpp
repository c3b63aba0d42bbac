#pragma once
// Options of rs-capture import for photos with known cameras anywhere around the object.

#include "capture/posed/posed_import.hpp"
#include "rayspace/base/result.hpp"

#include <CLI/CLI.hpp>

#include <string>

namespace rs::capture {

struct PosedCommandLine {
    bool posed = false;
    std::string up = "auto";
    std::string axes = "auto";

    /// True if an option is given that only posed photos have.
    [[nodiscard]] bool is_requested() const { return posed || up != "auto" || axes != "auto"; }
};

void add_posed_options(CLI::App& command, PosedCommandLine& given);

/// Imports the photos and prints the summary, as JSON if `json`, and the notes unless `quiet`. Up and axes of
/// `options` are set from `given`.
Status run_posed_import(PosedImportOptions options, const PosedCommandLine& given, bool json, bool quiet);

/// The same with cameras that COLMAP computes; `options.cameras` is set.
Status run_colmap_import(PosedImportOptions options, const PosedCommandLine& given, bool json, bool quiet);

}  // namespace rs::capture
