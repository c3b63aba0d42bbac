#pragma once
// Rendering every pose of a capture set and measuring the distance to its images
// (rayspace/image/image_metrics.hpp).

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
    double mean_psnr_db = 0;    // mean over views of the views' dB
    double pooled_psnr_db = 0;  // dB of all views' object pixels taken together; lower where views differ
    double mean_ssim = 0;
};

// `render` is called from several threads at once.
Result<Comparison> compare_with_set(const RenderView& render, const std::filesystem::path& set,
                                    Progress* progress = nullptr);
// `set` is in the units and the frame of the object's rig, as a second set traced of the same scene is.
Result<Comparison> compare_with_set(const Renderer& renderer, const std::filesystem::path& set,
                                    Progress* progress = nullptr);

}  // namespace rs::engine
