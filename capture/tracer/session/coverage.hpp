#pragma once
// Coverage of an image by the object, at more samples than the image itself: ground truth of alpha, and of recentring
// as in web shops, where each photo is shifted and scaled so that the object fills and centres the frame.

#include "capture/calibration/model/calibration.hpp"
#include "capture/tracer/image/ray_image.hpp"
#include "capture/tracer/rays/ray_scene.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

/// Share of each pixel square that surfaces cover at time 0, 0..1. Pixels on a contour, i.e. those whose first 16 rays
/// or whose neighbours differ, use 256 rays; objects too thin to be hit by the 16 rays of a pixel and its neighbours
/// are lost. Surfaces of every kind cover, including glass; texture holes do not. The result does not depend on the
/// thread count. \param threads 0 = one per hardware thread
Image<float> trace_coverage(const RayScene& scene, const RayImage& rays, int threads = 0);

inline constexpr double kRecentredFill = 0.88;  // size of the object over the frame's size, along the limiting axis

/// Placement that recentres the object in `coverage` (0..1, of the frame's size); the identity if it is empty.
ImagePlacement recentring_placement(const Image<float>& coverage);

/// Applies a placement to rays, as if the sensor had moved: without resampling.
RayImage apply_placement(RayImage rays, const ImagePlacement& place);

/// Resamples an image bilinearly at a placement; the border is extended.
Image<RgbaF> apply_placement(const Image<RgbaF>& image, const ImagePlacement& place);

}  // namespace rs::capture
