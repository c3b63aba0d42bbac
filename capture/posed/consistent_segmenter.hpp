#pragma once
/// \file
/// Segmenters of posed photos that use all views (silhouette_consistency.hpp): the masks are found in reduced photos,
/// and refined in full size when a photo is imported.

#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/segmentation/segmenter.hpp"
#include "capture/posed/cameras/posed_camera.hpp"
#include "capture/posed/visual_hull.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace rs::capture {

/// Photos of one size.
struct PhotosToSegment {
    const PhotoFolder* folder = nullptr;
    std::vector<PosedCamera> cameras;          ///< [photo], in the working size of the folder
    std::shared_ptr<const Segmenter> initial;  ///< background model; null: none fits
};

struct ConsistentSegmenters {
    std::vector<std::shared_ptr<const Segmenter>> segmenters;  ///< [element of the input]
    double changed = 0;  ///< mean share of the initial masks' pixels that changed; 0 without initial masks
};

/// Point at which the cameras look; may convert the axes of the cameras.
using TargetFinder = std::function<Result<glm::dvec3>(std::vector<HullView>&)>;

/// Reads and segments all photos. Memory: 5 bytes per pixel of the reduced photos (kHullMask_px). Errors: those of
/// reading; masks that the views do not agree about.
Result<ConsistentSegmenters> make_consistent_segmenters(std::span<const PhotosToSegment> groups,
                                                        const TargetFinder& find_target, Progress* progress);

}  // namespace rs::capture
