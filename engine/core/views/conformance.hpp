#pragma once
// Compares the fast core with the scalar definition on random views of an object.

#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>

namespace rs::engine {

struct ConformanceReport {
    int views = 0;
    int upright_views = 0;
    int on_ring_views = 0;  // upright views at a ring's distance and height
    std::int64_t pixels = 0;
    std::int64_t object_pixels = 0;     // alpha above 0
    std::int64_t different_pixels = 0;  // in colour or depth; 0: equal bit for bit
};

/// Renders random views with the scalar definition and with the core, and counts pixels that differ in colour or depth.
/// Sizes are up to 256x256. Of four views one is tilted, one is on a ring between its captured views, and the others
/// are at distances of 1.2 to 12 radii. The same seed gives the same views.
Result<ConformanceReport> check_conformance(RaySpaceObject object, int views, std::uint64_t seed,
                                            Progress* progress = nullptr);

}  // namespace rs::engine
