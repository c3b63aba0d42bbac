#pragma once
// The whole import: a folder of photographs of one turn -> a capture set (RGBA pictures and transforms.json).

#include "capture/calibration/known/known_files.hpp"
#include "capture/photos/background/backdrop.hpp"
#include "capture/photos/rig/nominal_rig.hpp"
#include "capture/photos/rig/photo_calibration.hpp"
#include "capture/photos/rig/rectification.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rs::capture {

struct ImportOptions {
    std::filesystem::path photos;  // folder
    std::filesystem::path output;  // folder; see StagedFolder for what may stand there already, which is replaced whole
    BackdropRequest backdrop;
    // Folder with one picture per photograph, of its name or that name with another picture ending: white where the
    // object is. Takes the place of cutting out. Empty: none.
    std::filesystem::path masks;

    CalibrationChoice calibration = CalibrationChoice::kAuto;
    KnownFile known;                         // held by calibration; the next three are added to it
    std::optional<double> fov_deg;           // horizontal, 1..120; else found (25 in a nominal rig)
    std::optional<double> degrees_per_view;  // 0.01..180; else found (360 / views in a nominal rig)
    std::optional<Turning> turning;          // else read from the pictures
    std::optional<BoardDesign> board;        // of the board that lies on the plate
    std::optional<double> axis_x_px;         // for a nominal rig; else from the silhouettes of a full turn
};

inline constexpr double kNominalFieldOfView_deg = 25;

struct ImportReport {
    int views = 0;  // of the set
    int width = 0;  // px, of the photographs
    int height = 0;
    BackdropKind backdrop = BackdropKind::kAlpha;
    Rgba8 backdrop_colour;
    bool backdrop_given = false;
    bool masks_given = false;
    std::string dropped_repeat;             // name of the last photograph where it repeated the first; empty otherwise
    std::vector<std::string> left_out;      // names of photographs that stand where another one does
    std::vector<std::string> source_names;  // [photograph] of all that took part in calibration
    NominalTurn nominal;
    PhotoCalibration calibration;
    CalibrationMethod method = CalibrationMethod::kNominal;
    UprightFrame frame;  // of the pictures written, where they were rectified
    double step_deg = 0;
    Turning turning = Turning::kClockwise;
    double fl_px = 0;         // of the set's pictures
    double distance = 0;      // object radii
    double min_coverage = 0;  // share of a photograph's pixels with alpha of 128 and more: smallest of all, ...
    double max_coverage = 0;  // ... largest
    std::vector<Image<Rgba8>> small_cut_outs;  // [photograph], the longer side at most 512 px
    std::vector<std::string> notes;            // one line each: what the user should know
};

std::string to_string(Turning turning);  // "clockwise", "counter-clockwise"

// Nothing is left at `output` when it fails. Besides the errors of its stages (photo_folder.hpp, backdrop.hpp,
// cut_turn.hpp, photo_calibration.hpp, rectification.hpp): options out of range; an output folder that is or contains
// the folder of photographs.
//
// Works on all cores as long as the photographs in work together stay below kWorkingMemory_bytes, 4 GiB
// (bounded_work.hpp): at 4000x3000 pixels, kCutBytesPerPixel = 150 bytes each, on two of them. To that come 12 bytes
// per pixel of one photograph for the plate, 16 more before a flat grey, and small copies of all photographs: 0.2 GB
// for the first pass, up to 1 MB per view for the second and up to 6.5 MB per view for calibration.
Result<ImportReport> import_photos(const ImportOptions& options, Progress* progress);

}  // namespace rs::capture
