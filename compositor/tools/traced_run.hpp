#pragma once
// rs-view by traced light: images, pieces of them, and probes.

#include "compositor/scene/scene.hpp"
#include "compositor/tools/view_options.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "compositor/viewer/showroom.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

#include <memory>
#include <vector>

namespace rs::compositor {

// Null for the raster renderer, and where the image comes in pieces that were traced before.
Result<std::unique_ptr<TracedRenderer>> requested_tracer(const ViewArguments& arguments, const Scene& scene,
                                                         Showroom& showroom);

// By as many passes or seconds as were requested, one pass at least.
std::shared_ptr<const Image<Rgba8>> trace(TracedRenderer& tracer, const ViewArguments& arguments, const Camera& camera,
                                          Progress& progress);

// A piece of one frame's traced image.
Status run_tile(const ViewArguments& arguments, const Scene& scene, Showroom& showroom,
                const std::vector<Camera>& cameras);

// The map of what reaches a place.
Status run_probe(const ViewArguments& arguments);

}  // namespace rs::compositor
