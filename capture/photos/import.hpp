#pragma once
// The whole import: a folder of photographs of one turn -> a capture set (RGBA pictures and transforms.json).

#include "capture/photos/backdrop.hpp"
#include "capture/photos/nominal_rig.hpp"
#include "rayspace/progress.hpp"
#include "rayspace/result.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rs::capture {

struct ImportOptions {
    std::filesystem::path photos;  // folder
    std::filesystem::path output;  // folder; see StagedFolder for what may stand there already, which is replaced whole
    BackdropRequest backdrop;
    double fov_deg = 25;                     // horizontal, 1..120
    std::optional<double> degrees_per_view;  // 0.01..180; otherwise 360 / views
    std::optional<double> axis_x_px;         // otherwise found from the silhouettes of a full turn
    std::optional<Turning> turning;          // otherwise read from the pictures
};

struct ImportReport {
    int views = 0;
    int width = 0;  // px
    int height = 0;
    BackdropKind backdrop = BackdropKind::kAlpha;
    Rgba8 backdrop_colour;
    bool backdrop_given = false;
    std::string dropped_repeat;  // name of the last photograph where it repeated the first; empty otherwise
    double step_deg = 0;
    double axis_x_px = 0;
    double axis_spread_px = 0;
    std::string axis_from;  // "silhouettes", "given", "picture middle"
    Turning turning = Turning::kClockwise;
    std::string turning_from;  // "pictures", "given", "assumed"
    double fl_px = 0;
    double distance = 0;      // object radii
    double min_coverage = 0;  // share of the picture's pixels with alpha of 128 and more: smallest of all views, ...
    double max_coverage = 0;  // ... largest
    std::vector<std::string> notes;  // one line each: what the user should know
};

std::string to_string(Turning turning);  // "clockwise", "counter-clockwise"

// Nothing is left at `output` when it fails. Besides the errors of its stages (photo_folder.hpp, backdrop.hpp,
// cut_turn.hpp): options out of range; an output folder that is or contains the folder of photographs.
//
// Works on all cores as long as the photographs in work together stay below kWorkingMemory_bytes, 4 GiB
// (bounded_work.hpp): at 4000x3000 pixels, kCutBytesPerPixel = 150 bytes each, on two of them. To that come 12 bytes
// per pixel of one photograph for the plate, and small copies of all photographs, 0.2 GB for the first pass and up to 1
// MB per view for the second.
Result<ImportReport> import_photos(const ImportOptions& options, Progress* progress);

}  // namespace rs::capture
