#pragma once
/// \file
/// Second pass over the photos: segments each, caches its foreground image, and collects statistics of the whole turn
/// for the later stages. Runs between choose_segmenter() and find_rig().

#include "capture/photos/foreground/foreground_parameters.hpp"
#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/segmentation/foreground_cache.hpp"
#include "capture/photos/segmentation/segmenter.hpp"
#include "capture/photos/segmentation/turn_silhouette.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rs::capture {

/// Peak memory of segmenting a photo, bytes per pixel: every pixel undecided, so that it is a node with eight edges of
/// the graph cut (graph_cut.hpp). Typical photos take two thirds, for the colours of both sides of the edge
/// (alpha_estimation.hpp).
inline constexpr int kSegmentBytesPerPixel = 170;

struct SegmentedTurn {
    TurnSilhouette silhouette;
    std::vector<TurnSilhouette::Box> boxes;  ///< [photo] visible pixels
    std::vector<double> coverage;            ///< [photo] share of the pixels with alpha >= 128, 0..1
    std::vector<std::uint8_t> at_border;     ///< [photo] 1 if one of these pixels lies at the image border
    std::vector<Image<Rgba8>> small;         ///< [photo] foreground image, longer side at most 512 px
};

/// File name of view 0, 1, ... within a set: "images/0000.png".
std::string set_image_name(std::size_t view);

/// Segments all photos and puts their foreground images into `foregrounds`. Errors: a photo that cannot be read or has
/// changed its size, one that shows no object or, unless its alpha is given, nothing but the object; the segmenter's.
Result<SegmentedTurn> segment_turn(const PhotoFolder& folder, const Segmenter& segmenter,
                                   const ForegroundCache& foregrounds, Progress* progress,
                                   const ForegroundParameters& parameters = {});

}  // namespace rs::capture
