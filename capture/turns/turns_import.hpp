#pragma once
/// \file
/// Import of several turntable turns of one object, each with its own height of the camera, into one posed capture set:
///
///   find_turns()           folders or names of files -> photos of each turn
///   prepare_turn()         each turn segmented alone                   photos/import.hpp
///   correct_masks()        masks completed by the colours of all       joint_segmentation.hpp
///   find_rig()             each turn calibrated alone, if possible     photos/rig/found_rig.hpp
///   register_turns()       all turns in one frame                      turn_registration.hpp
///   write_posed_image(), posed_rig()                                   posed/posed_set.hpp

#include "capture/photos/import.hpp"
#include "capture/turns/turn_registration.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace rs::capture {

/// Photos of one turn, in order.
struct TurnSource {
    std::string name;  ///< of the folder, or of the row with its folder
    std::vector<std::filesystem::path> photos;
};

/// The turns of one or several folders: each folder is a turn; a single folder may have a folder for each turn, or
/// photos whose names carry row and column (intake/photo_rows.hpp). One element: the photos are one turn. Errors: a
/// folder that cannot be listed or has no photos; a single folder with both photos and folders of photos in rows.
Result<std::vector<TurnSource>> find_turns(std::span<const std::filesystem::path> folders);

struct ImportedTurn {
    std::string name;
    std::size_t views = 0;
    RegisteredTurn registered;
    CalibrationMethod calibration = CalibrationMethod::kNominal;  ///< of the turn alone; nominal: none
    double elevation_deg = 0;                                     ///< of its camera above the object's middle
    double axis_tilt_deg = 0;  ///< between the axes of this turn and the first; 0: the object stands upright in both
    double azimuth_deg = 0;    ///< rotation of the object on the table relative to the first turn, if it stands upright
    double distance = 0;       ///< of its camera from the object's middle, object radii
};

/// The turn as in photo_import of the set and in the JSON summary.
nlohmann::json turn_json(const ImportedTurn& turn);

struct TurnsImportReport {
    std::vector<ImportedTurn> turns;
    std::size_t views = 0;
    SegmenterKind segmenter = SegmenterKind::kAlpha;  ///< of the first turn
    double radius = 0;  ///< of the object's bounding cylinder, in camera distances of the reference turn
    double height = 0;
    std::vector<std::string> notes;
};

/// Imports two or more turns. `options` apply to each turn; options.photos is not used. Nothing is left at
/// options.output if it fails. Errors, by name of the turn: those of the stages; fewer than six photos; a turn that is
/// given twice; images that were shifted and scaled individually.
Result<TurnsImportReport> import_turns(std::span<const TurnSource> sources, const ImportOptions& options,
                                       Progress* progress);

}  // namespace rs::capture
