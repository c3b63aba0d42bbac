#pragma once
// The whole import: a folder of photographs of one turn -> a capture set (RGBA pictures and transforms.json). Six
// stages in a row:
//
//   open_photos()      folder or film -> photographs                     intake/photo_source.hpp
//   take_in()          photographs -> those of the turn, small copies    intake/intake.hpp
//   find_backdrop()    small copies -> backdrop                          background/backdrop.hpp
//   cut_turn()         photographs, backdrop -> cut-outs                 matte/cut_turn.hpp
//   find_rig()         cut-outs -> lens, axis, angles                    rig/found_rig.hpp
//   write_import_set() cut-outs, rig -> pictures and transforms.json     report/import_set.hpp

#include "capture/photos/background/backdrop.hpp"
#include "capture/photos/report/import_report.hpp"
#include "capture/photos/rig/found_rig.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/pictures/photograph_size.hpp"

#include <filesystem>
#include <optional>

namespace rs::capture {

struct ImportOptions : RigRequest {
    std::filesystem::path photos;  // folder, or a film (intake/photo_source.hpp)
    std::filesystem::path output;  // folder; see StagedFolder for what may stand there already, which is replaced whole
    BackdropRequest backdrop;
    // Folder with one picture per photograph, of its name or that name with another picture ending: white where the
    // object is. Takes the place of cutting out. Empty: none.
    std::filesystem::path masks;
    // Larger photographs are made smaller first (open_photo_folder()); kMinSide_px .. kMaxPictureSide_px.
    int max_side_px = kDefaultMaxSide_px;
    // Number of frames of a film, or of photos of a larger folder, to select: kMinSelectedFrames .. kMaxSelectedFrames
    // (intake/film/frame_selection.hpp). Empty: see intake/photo_source.hpp.
    std::optional<int> frames;
};

// Nothing is left at `output` when it fails. Besides the errors of its stages (and photo_folder.hpp's): options out of
// range; an output folder that is or contains the folder of photographs; one or two photographs, unless a nominal rig
// or a known one is asked for.
//
// Works on all cores as long as the photographs in work together stay below kWorkingMemory_bytes, 4 GiB
// (bounded_work.hpp): at 4000x3000 pixels that are not made smaller, kCutBytesPerPixel = 170 bytes each, on two of
// them. To that come 12 bytes per pixel of one picture for the clean plate, 16 more before a flat grey, and small
// copies of all photographs: 0.2 GB for the first pass, up to 1 MB per view for the second and up to 6.5 MB per view
// for calibration.
Result<ImportReport> import_photos(const ImportOptions& options, Progress* progress);

}  // namespace rs::capture
