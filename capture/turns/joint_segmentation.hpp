#pragma once
/// \file
/// Corrects the masks of turns of one object by the colours of all turns. A part of the object that looks like the
/// background from one height of the camera (a white roof seen edge-on before white) is often clear from another: its
/// colours are then frequent in the masks of all turns and rare beside them. Such pixels are added to the masks; none
/// are removed. Runs between prepare_turn() and find_rig().

#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/segmentation/foreground_cache.hpp"
#include "capture/photos/segmentation/segment_turn.hpp"
#include "capture/photos/segmentation/segmenter.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <memory>
#include <span>
#include <vector>

namespace rs::capture {

/// A turn that was segmented alone.
struct TurnToCorrect {
    const PhotoFolder* folder = nullptr;
    const ForegroundCache* foregrounds = nullptr;
    TurnSilhouette::Box visible;  ///< of the object in any photo
};

struct CorrectedTurn {
    /// Adds to the alpha in the turn's cache, which must outlive it; the other turns' are not used any more. Null if
    /// hardly any pixels are added.
    std::shared_ptr<const Segmenter> segmenter;
    double added = 0;  ///< mean share of the masks' areas
};

/// Reads all photos twice. Errors: those of reading.
Result<std::vector<CorrectedTurn>> correct_masks(std::span<const TurnToCorrect> turns, Progress* progress);

}  // namespace rs::capture
