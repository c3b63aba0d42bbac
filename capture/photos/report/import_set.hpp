#pragma once
/// \file
/// Last stage of an import: writes the capture set of a turn with a known rig. The images of a calibrated turn are
/// rectified; those of a nominal one are the foreground images, unchanged.

#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/report/import_report.hpp"
#include "capture/photos/segmentation/segment_turn.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>

namespace rs::capture {

/// Writes the images into `set`/images, which must exist, and transforms.json into `set`. `report` holds the results of
/// the previous stages; returns it with the numbers of the set added. Errors: those of plan_upright_frame(), unreadable
/// foreground images, failures of the disk.
Result<ImportReport> write_import_set(const std::filesystem::path& set, const PhotoFolder& folder,
                                      const SegmentedTurn& turn, const ForegroundCache& foregrounds,
                                      ImportReport report, Progress* progress);

}  // namespace rs::capture
