#pragma once
// Does the fast core compute what engine/RECONSTRUCTION.md defines, on this machine and this object?

#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>

namespace rs::engine {

struct ConformanceReport {
    int views = 0;
    int upright_views = 0;
    int on_ring_views = 0;  // upright ones from a ring's own distance and height
    std::int64_t pixels = 0;
    std::int64_t object_pixels = 0;     // with alpha above 0
    std::int64_t different_pixels = 0;  // in colour or depth; 0 = bit for bit equal
};

// Renders `views` random views (sizes up to 256x256; of four views one is tilted and one stands on a ring between its
// captured views, the others are at 1.2 to 12 radii) with the scalar definition and with the core, and counts pixels
// that differ in colour or depth. The same seed gives the same views.
Result<ConformanceReport> check_conformance(RaySpaceObject object, int views, std::uint64_t seed,
                                            Progress* progress = nullptr);

}  // namespace rs::engine
