#pragma once
// How much of each pixel a scene's surfaces cover: the true alpha of an image, finer than an image's own samples.

#include "capture/tracer/image/ray_image.hpp"
#include "capture/tracer/rays/ray_scene.hpp"

namespace rs::capture {

// Shares 0..1 over pixel squares, the same whatever the number of threads (0 = all). Pixels on an outline, i.e. those
// whose first 16 rays or whose neighbours differ, take 256 rays; what is so thin that all 16 rays of a pixel and of its
// neighbours miss it is lost. Surfaces of every kind cover alike, glass too; holes of textures do not.
// What moves stands where it is at time 0.
Image<float> trace_coverage(const RayScene& scene, const RayImage& rays, int threads = 0);

}  // namespace rs::capture
