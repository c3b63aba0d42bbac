#pragma once
// The last stage of an import: the capture set of a turn whose rig was found. A calibrated turn's pictures are
// rectified, a nominal one's stay as they were cut out.

#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/report/import_report.hpp"
#include "capture/photos/segmentation/segment_turn.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>

namespace rs::capture {

// Writes pictures into `set`/images, which exists, and transforms.json into `set`. Gives back `report`, of all that was
// found before, with the numbers of the set. Errors: those of plan_upright_frame(), the disk.
Result<ImportReport> write_import_set(const std::filesystem::path& set, const PhotoFolder& folder,
                                      const SegmentedTurn& turn, const CutoutCache& cuts, ImportReport report,
                                      Progress* progress);

}  // namespace rs::capture
