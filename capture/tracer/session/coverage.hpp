#pragma once
// Ground-truth alpha of an image: the share of each pixel covered by surfaces, at more samples than the image itself.

#include "capture/tracer/image/ray_image.hpp"
#include "capture/tracer/rays/ray_scene.hpp"

namespace rs::capture {

/// Coverage 0..1 of each pixel square at time 0. Pixels on a contour, i.e. those whose first 16 rays or whose
/// neighbours differ, use 256 rays; objects too thin to be hit by the 16 rays of a pixel and its neighbours are lost.
/// Surfaces of every kind cover, including glass; texture holes do not. The result does not depend on the thread count.
/// \param threads 0 = one per hardware thread
Image<float> trace_coverage(const RayScene& scene, const RayImage& rays, int threads = 0);

}  // namespace rs::capture
