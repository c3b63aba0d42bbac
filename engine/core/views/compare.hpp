#pragma once
// Comparisons of rendered views: with the photos of a capture set (rayspace/image/image_metrics.hpp), and of the fast
// core with the scalar definition.

#include "engine/core/fast/renderer.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"
#include "rayspace/output/view_output.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rs::engine {

struct ComparedView {
    std::string image;
    double psnr_db = 0;
    double ssim = 0;
};

struct Comparison {
    std::vector<ComparedView> views;
    double mean_psnr_db = 0;    // mean of the PSNR of the views
    double pooled_psnr_db = 0;  // PSNR of the object pixels of all views together; lower if the views differ in quality
    double mean_ssim = 0;
};

/// Compares every view of `set`. `render` is called from several threads at once.
Result<Comparison> compare_with_set(const RenderView& render, const std::filesystem::path& set,
                                    Progress* progress = nullptr);
/// As above; `set` is in the units and the frame of the object's rig, such as a second set traced from the same scene.
Result<Comparison> compare_with_set(const Renderer& renderer, const std::filesystem::path& set,
                                    Progress* progress = nullptr);

/// Comparison of the fast core with the scalar definition.
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
