#pragma once
// Renders every pose of a capture set and compares the views with its photos (rayspace/image/image_metrics.hpp).

#include "engine/core/fast/renderer.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/output/view_output.hpp"

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

}  // namespace rs::engine
