#pragma once
// Finds parts that masks lack. A surface point that neighboring photos agree about is inside every true silhouette,
// even where it is occluded; where it projects outside of one, that mask lacks a part. A part missing from one mask
// would remove the surface from the visual hull for all views. Only points within the searched hull are found.

#include "encode/raymap/silhouettes/visual_hull.hpp"
#include "encode/raymap/silhouettes/work_view.hpp"
#include "rayspace/image/image.hpp"

#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace rs::encode {

struct SpacePoint {
    glm::dvec2 place{0, 0};  // x and z, object radii
    double y = 0;
};

/// A point of a photo's depth map, and the points one tolerance nearer and farther.
struct RuledOutPoint {
    SpacePoint nearest, found, farthest;
};

/// The points of a photo's opaque pixels that each photo of `beside` confirms but `hull` rules out, also `tolerance`
/// object radii nearer and farther.
/// \param searched  the hull in which the depths were estimated; points outside of it are ignored.
std::vector<RuledOutPoint> find_ruled_out(const DepthView& image, std::span<const DepthView* const> beside,
                                          double tolerance, const SampledHull& searched, const SampledHull& hull);

/// Projects the points of several photos into a view: the nearest depth (as DepthView::depth) in each pixel with a
/// point that in all three places projects to a pixel neither of the object nor next to it; kNoDepth elsewhere, and
/// everywhere where the view shows no object.
Image<float> missing_depths(const WorkView& view, std::span<const std::vector<RuledOutPoint>> points);

/// Makes the pixels with a depth, and those next to them, part of the object. `missing` belongs to the half-sized view.
void fill_missing(WorkView& view, const Image<float>& missing);

}  // namespace rs::encode
