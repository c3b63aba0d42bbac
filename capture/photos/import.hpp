#pragma once
/// \file
/// The whole import: photos or a video of one turn -> a capture set (RGBA images and transforms.json). Seven stages:
///
///   open_photos()        folder or video -> photos                        intake/photo_source.hpp
///   run_intake()            photos -> those of the turn, small copies        intake/intake.hpp
///   choose_segmenter()   small copies -> segmenter                        segmentation/segmenter_choice.hpp
///   segment_turn()       photos, segmenter -> foreground images                    segmentation/segment_turn.hpp
///   check_segmentation() foreground images -> problems              segmentation/segmentation_checks.hpp
///   find_rig()           foreground images -> lens, axis, angles                   rig/found_rig.hpp
///   write_import_set()   foreground images, rig -> set      report/import_report.hpp

#include "capture/photos/intake/intake.hpp"
#include "capture/photos/report/import_report.hpp"
#include "capture/photos/rig/found_rig.hpp"
#include "capture/photos/segmentation/segment_turn.hpp"
#include "capture/photos/segmentation/segmenter_choice.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image_io/photo_size.hpp"

#include <filesystem>
#include <optional>

namespace rs::capture {

struct ImportOptions : RigRequest {
    std::filesystem::path photos;  ///< folder, or a video (intake/photo_source.hpp)
    std::filesystem::path output;  ///< folder; an existing one is replaced as StagedFolder states
    SegmenterRequest segmentation;
    /// Write a set whose checks failed, with their findings as notes, and replace an existing folder whatever it holds.
    bool force = false;
    /// Larger photos are reduced first (open_photo_folder()); kMinSide_px .. kMaxImageSide_px.
    int max_side_px = kDefaultMaxSide_px;
    /// Number of frames of a video, or of photos of a larger folder, to select: kMinSelectedFrames ..
    /// kMaxSelectedFrames (intake/video/frame_selection.hpp). Empty: see intake/photo_source.hpp.
    std::optional<int> frames;
};

/// Photos of a turn, segmented.
struct PreparedTurn {
    Intake intake;
    ChosenSegmenter chosen;  ///< without its segmenter
    SegmentedTurn turn;
};

/// First five stages, with the problems of the segmentation as errors, or as notes with `options.force`. Puts the
/// foreground images into the folder `cut`, which must exist: ForegroundCache(cut, width, height) of the intake's
/// folder. options.photos is named in messages.
Result<PreparedTurn> prepare_turn(const ImportOptions& options, PhotoFolder folder, const std::filesystem::path& cut,
                                  Progress* progress);

/// Errors of option values that are out of range.
Status check_import_options(const ImportOptions& options);

/// Imports a folder of photos. Nothing is left at `output` if it fails. Errors, besides those of the stages: options
/// out of range; an output folder that is or contains the folder of photos; one or two photos, unless a nominal rig or
/// a known one is requested; a result that is not usable, unless `force`: one line per finding, each with its remedy.
///
/// Uses all cores as long as the photos in work together stay below kWorkingMemory_bytes, 4 GiB (bounded_work.hpp): at
/// 4000x3000 px that are not reduced, kSegmentBytesPerPixel = 170 bytes each, on two of them. To that come 12 bytes per
/// pixel of one image for the clean plate, 16 more before a flat grey, and small copies of all photos: 0.2 GB for the
/// first pass, up to 1 MB per view for the second and up to 6.5 MB per view for calibration.
Result<ImportReport> import_photos(const ImportOptions& options, Progress* progress);

}  // namespace rs::capture
