#pragma once
// Parts that cut-outs lack. A point of the surface that a picture and those beside it agree about lies within every
// true silhouette, whatever hides it there; where it appears beside one, that cut-out lacks a part. A part lost in a
// view from behind would take the surface away from views of the front. What is found so lies within the hull that was
// searched.

#include "encode/raymap/silhouettes/visual_hull.hpp"
#include "encode/raymap/silhouettes/work_view.hpp"
#include "rayspace/image/image.hpp"

#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace rs::encode {

struct PlaceInSpace {
    glm::dvec2 place{0, 0};  // x and z, object radii
    double y = 0;
};

// Where a picture shows a point, and as far nearer and farther as it may lie.
struct RuledOutPoint {
    PlaceInSpace nearest, found, farthest;
};

// The points of a picture's depths, of opaque pixels only, that each picture of `beside` shows, too, but the hull rules
// out: there, and `tolerance` object radii nearer and farther. `searched` is the hull that the depths were searched in:
// what lies outside of it has no colours to speak for it.
std::vector<RuledOutPoint> ruled_out(const DepthView& picture, std::span<const DepthView* const> beside,
                                     double tolerance, const SampledHull& searched, const SampledHull& hull);

// The nearest depths of points (as DepthView::depth) in pixels of the view where one appears that, in all three places,
// appears in a pixel that is not of the object, nor next to it; kNoDepth elsewhere. `points` are of several pictures.
// None where the view shows no object.
Image<float> missing_depths(const WorkView& view, std::span<const std::vector<RuledOutPoint>> points);

// Makes the pixels with a depth object, and those next to them. `missing` is of a view of half the size (halved).
void fill_missing(WorkView& view, const Image<float>& missing);

}  // namespace rs::encode
